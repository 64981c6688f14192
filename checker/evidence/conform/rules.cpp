// The names and sentences of the rules and faults.
#include <array>
#include <cstddef>
#include <utility>

#include "checker/evidence/conform/conform.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "model/implementations.hpp"

namespace stormproof::conform {

namespace {

struct Text {
  std::string_view name;
  std::string_view statement;
  std::array<Sender, 2> senders{};
  std::size_t sender_count = 0;

  template <class... Senders>
  constexpr Text(std::string_view name_, std::string_view statement_, Senders... by)
      : name{name_}, statement{statement_}, senders{{by...}}, sender_count{sizeof...(by)} {}
};

constexpr std::array<Text, rule_count> rules{{
    {"announcement.scheduled",
     "SPDP by multicast, or to the ports of static peers, when the announcement timer expires",
     sends::announcement_due},
    {"announcement.resent",
     "SPDP by multicast, or to the ports of static peers, because a participant was recognised",
     sends::resent},
    {"announcement.copy", "SPDP by unicast to a participant that is known", sends::copies_due,
     sends::copies_resent},
    {"heartbeat.open", "to one reader, when the writer side of the relation opens", sends::opening},
    {"heartbeat.reply", "to one reader, in answer to its initial ACKNACK",
     sends::answer_to_initial},
    {"heartbeat.periodic",
     "to all readers, when the writer's timer expires and something is not acknowledged",
     sends::expiry},
    {"heartbeat.piggyback", "to all readers, when DATA has used up the piggyback budget",
     sends::budget_of_pushed, sends::budget_of_requested},
    {"heartbeat.same_host",
     "to all readers, because of DATA to the writer's own host, which the capture does not show"},
    {"data.push", "to all readers, when the endpoint is created after the relation opened",
     sends::pushed},
    {"data.pull", "the first transmission of an older descriptor, after an ACKNACK asked for it",
     sends::requested},
    {"data.repair", "again, after an ACKNACK asked for it while it was unacknowledged",
     sends::requested},
    {"data.to_everybody",
     "to a reader that did not ask, with a message during which another reader was matched"},
    {"acknack.reply", "the heartbeat response delay after a HEARTBEAT arrived", sends::reply},
    {"acknack.initial", "the initial ACKNACK delay after the relation opened without a HEARTBEAT",
     sends::initial},
    {"announcement.reply",
     "SPDP to one participant by name, when it was recognised and at intervals after that",
     sends::cyclone::reply_due},
    {"heartbeat.answer", "to one reader, because of its pre-emptive ACKNACK or its request",
     sends::cyclone::answer},
    {"heartbeat.on_write", "to all readers, in a datagram with DATA of the same writer"},
    {"data.merged", "to all readers, because another one asked while it was queued",
     sends::cyclone::requested},
    {"data.same_host",
     "to all readers, because of a request on the writer's own host, which the capture does not "
     "show"},
    {"acknack.again", "without a HEARTBEAT, the renewal delay after the last request",
     sends::cyclone::reply},
    {"registration.scheduled", "DATA(p) of a client, when its announcement timer expires",
     sends::server::announces_first, sends::server::announces},
    {"registration.tick", "DATA(p) of a client, at a tick at which it does not know the server",
     sends::server::tick},
    {"registration.open",
     "HEARTBEAT(p) of a client, with its first DATA(p), or when it meets the server",
     sends::server::first_heartbeat, sends::server::heartbeat_to_server_met},
    {"registration.reply", "HEARTBEAT(p) of a client, in answer to an initial ACKNACK(p)",
     sends::server::asked_heartbeat},
    {"registration.periodic", "HEARTBEAT(p) of a client that has not been acknowledged",
     sends::server::heartbeat_again},
    {"registration.acknack", "ACKNACK(p) of the server, after a HEARTBEAT(p) arrived",
     sends::server::registered},
    {"registration.initial", "ACKNACK(p) of the server, without a HEARTBEAT(p)",
     sends::server::initial_of_server},
    {"relay.open", "HEARTBEAT of the server, when a client has announced itself",
     sends::server::opening},
    {"relay.reply", "HEARTBEAT of the server, in answer to an initial ACKNACK",
     sends::server::answer_to_initial},
    {"relay.periodic",
     "HEARTBEAT of the server, when its timer expires and a client lacks something",
     sends::server::expiry},
    {"relay.heartbeat", "HEARTBEAT of the server, with DATA or with the GAP before it",
     sends::server::served, sends::server::skipped},
    {"relay.data", "what the server passes on, for the first time to this client",
     sends::server::served},
    {"relay.repair", "again, after an ACKNACK asked for it", sends::server::served},
    {"relay.gap", "what the client need not have, before the first DATA behind it",
     sends::server::skipped},
    {"relay.gap_reply", "what the client need not have, after an ACKNACK asked for it",
     sends::server::irrelevant},
    {"relay.gap_to_everybody", "what no client need have, before a DATA; real servers send it"},
    {"relay.acknack", "ACKNACK of a client, after a HEARTBEAT of the server arrived",
     sends::server::reply},
    {"relay.initial", "ACKNACK of a client, without a HEARTBEAT of the server",
     sends::server::initial},
    {"relay.answer", "the server's own DATA(p), when a client has announced itself",
     sends::server::own},
}};

constexpr std::array<std::string_view, fault_count> faults{
    "not_announced",           "not_opened",      "announcement_extra", "announcement_due",
    "heartbeat_cause",         "heartbeat_range", "heartbeat_copies",   "heartbeat_due",
    "heartbeat_count",         "data_cause",      "data_order",         "data_early",
    "data_acknowledged",       "gap_cause",       "acknack_cause",      "acknack_early",
    "acknack_count",           "acknack_content", "initial_early",      "initial_late",
    "initial_after_heartbeat", "unanswered",      "other_version",      "lookup_cause",
    "number_beyond",           "no_such_rule"};

constexpr std::array<std::string_view, 6> kinds{"received",        "lost",       "dropped",
                                                "still_under_way", "recognised", "timer"};
constexpr std::array<std::string_view, 3> verdicts{"conforms", "does not conform", "inconclusive"};

}  // namespace

std::string_view name_of(Rule rule) { return rules[static_cast<std::size_t>(rule)].name; }
std::string_view statement_of(Rule rule) { return rules[static_cast<std::size_t>(rule)].statement; }
bool is_rule_of(Rule rule, const model::DdsProfile& dds) {
  const model::ImplementationTraits& traits = model::traits_of(dds);
  const bool is_of_cyclone = traits.writer == model::Writer::of_cyclone;
  if (rule >= Rule::registration_scheduled) return traits.has_server;
  switch (rule) {
    case Rule::announcement_scheduled:
    case Rule::announcement_copy:
      return !traits.has_server;
    case Rule::announcement_resent:
    case Rule::heartbeat_same_host:
    case Rule::data_to_everybody:
      return !is_of_cyclone && !traits.has_server;
    case Rule::heartbeat_periodic:
    case Rule::data_push:
    case Rule::data_pull:
    case Rule::data_repair:
    case Rule::acknack_reply:
    case Rule::acknack_initial:
      return true;
    default:
      return is_of_cyclone == (rule >= Rule::announcement_reply);
  }
}
std::span<const Sender> senders_of(Rule rule) {
  const Text& text = rules[static_cast<std::size_t>(rule)];
  return std::span{text.senders}.first(text.sender_count);
}
std::string_view name_of(Fault fault) { return faults[static_cast<std::size_t>(fault)]; }
std::string_view name_of(Hidden::Kind kind) { return kinds[static_cast<std::size_t>(kind)]; }
std::string_view name_of(Verdict verdict) { return verdicts[static_cast<std::size_t>(verdict)]; }

}  // namespace stormproof::conform
