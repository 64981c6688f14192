// One pass over the events for silence; the rest is in the counts.
#include "checker/evidence/doctor/symptoms.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/capture/unknown_types.hpp"
#include "checker/evidence/doctor/repairs.hpp"
#include "checker/evidence/validate/creation_times.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

using capture::Conversation;
using capture::Counting;
using capture::Event;
using capture::GuidPrefix;
using capture::HeartbeatKind;
using report::grouped;
using report::percent;
using report::plural;

/// Participants to which much was sent that asks for an answer, and that never answered anybody.
struct Silence {
  std::vector<std::size_t> participants{};  ///< numbers in the topology
  std::uint64_t messages = 0;               ///< that were sent to them in vain
};

Silence find_silence(const Conversation& conversation, const Counting& counting) {
  constexpr std::uint64_t worth_an_answer = 10;
  std::map<GuidPrefix, std::uint64_t> told;
  std::set<GuidPrefix> answered;
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    const Event& event = conversation.events[k];
    if (!counting.classes[k]) continue;
    if (event.acknack() != nullptr) answered.insert(event.source);
    const bool asks = event.heartbeat() != nullptr || event.traffic() == capture::Traffic::sedp;
    if (asks && event.acknack() == nullptr && event.destination) ++told[*event.destination];
  }
  Silence silence;
  const auto& list = conversation.topology.participants;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto found = told.find(list[k].prefix);
    if (found == told.end() || found->second < worth_an_answer) continue;
    if (answered.contains(list[k].prefix)) continue;
    silence.participants.push_back(k);
    silence.messages += found->second;
  }
  return silence;
}

/// Somebody announces itself when others have all their endpoints: it has to ask for them, and what
/// it is answered counts towards the next HEARTBEAT to everybody.
struct SpreadStarts {
  std::size_t newcomers = 0;     ///< participants that came so late
  std::int64_t took_ns = 0;      ///< from the first announcement to the last participant's
  std::uint64_t heartbeats = 0;  ///< piggyback ones, of those who had everything by then
};

SpreadStarts find_spread_starts(const Conversation& conversation, const Counting& counting) {
  const auto& list = conversation.topology.participants;
  const auto created = validate::creation_times(conversation, counting.until_ns);
  std::map<GuidPrefix, std::int64_t> until_newcomer;  // of those who had everything
  std::set<GuidPrefix> newcomers;
  for (const auto& [prefix, times] : created) {
    for (const capture::Participant& other : list) {
      if (other.first_ns <= times.last_latest || other.first_ns > counting.until_ns) continue;
      newcomers.insert(other.prefix);
      std::int64_t& first = until_newcomer.try_emplace(prefix, other.first_ns).first->second;
      first = std::min(first, other.first_ns);
    }
  }
  SpreadStarts found{newcomers.size()};
  if (newcomers.empty()) return found;
  const auto [first, last] = std::ranges::minmax(list, {}, &capture::Participant::first_ns);
  found.took_ns = last.first_ns - first.first_ns;
  for (const auto& [k, kind] : counting.kinds) {
    const bool is_piggyback =
        kind == HeartbeatKind::fan_out_piggyback || kind == HeartbeatKind::directed_piggyback;
    const Event& event = conversation.events[k];
    const auto since = until_newcomer.find(event.source);
    if (!is_piggyback || !counting.classes[k] || since == until_newcomer.end()) continue;
    if (event.time_ns >= since->second) ++found.heartbeats;
  }
  return found;
}

/// `value` beyond `needed`.
std::uint64_t beyond(std::uint64_t value, std::uint64_t needed) {
  return value > needed ? value - needed : 0;
}

class Diagnosis {
 public:
  Diagnosis(const Conversation& conversation, const Counting& counting,
            const model::Counts& failure_free)
      : conversation_{conversation}, counting_{counting}, needed_{failure_free} {}

  std::vector<Cause> run() {
    heartbeats();
    repairs();
    readers_that_ask_again();
    announcements();
    lookups();
    silence();
    std::ranges::stable_sort(causes_, std::ranges::greater{}, &Cause::messages);
    return std::move(causes_);
  }

 private:
  void add(const char* id, std::uint64_t messages, std::string sentence, std::string remedy) {
    if (messages > 0) {
      causes_.push_back({id, messages, std::move(sentence), std::move(remedy)});
    }
  }

  [[nodiscard]] std::uint64_t of(HeartbeatKind kind) const { return counting_.heartbeats.of(kind); }

  void heartbeats() {
    const std::uint64_t all = counting_.counts.heartbeat;
    const SpreadStarts spread = find_spread_starts(conversation_, counting_);
    const std::uint64_t piggyback = of(HeartbeatKind::fan_out_piggyback) +
                                    of(HeartbeatKind::directed_piggyback) - spread.heartbeats;
    add("spread_starts", spread.heartbeats,
        fmt::format(
            "{} of {} HEARTBEATs ({}) were sent because of DATA after somebody had come late: {} "
            "announced themselves when others had all their endpoints, the last one {} after the "
            "first. Who comes late asks for what is there, and each time the answers have filled "
            "the send buffer everybody is told everything again.",
            grouped(spread.heartbeats), grouped(all), percent_of(spread.heartbeats, all),
            plural(spread.newcomers, "participant"),
            report::duration(model::Nanoseconds{spread.took_ns})),
        "all at once instead (`stormproof launch` compares), or a larger send buffer");
    add("piggyback", beyond(piggyback, needed_.heartbeat),
        fmt::format(
            "{} of {} HEARTBEATs ({}) were sent because DATA was sent: the writer announces "
            "everything again to every reader each time it has filled its send buffer, and "
            "every reader answers.",
            grouped(piggyback), grouped(all), percent_of(piggyback, all)),
        "a larger send buffer, so that DATA is announced by fewer HEARTBEATs");
    const std::uint64_t timer = of(HeartbeatKind::fan_out_periodic) + of(HeartbeatKind::fan_out);
    add("heartbeat_timer", beyond(timer, needed_.heartbeat),
        fmt::format("{} of {} HEARTBEATs ({}) come from the writers' timers, which run as long as "
                    "any reader has not acknowledged everything.",
                    grouped(timer), grouped(all), percent_of(timer, all)),
        "a longer HEARTBEAT period");
  }

  void repairs() {
    const Repairs found = find_repairs(conversation_, counting_, counting_.until_ns);
    const std::uint64_t all = counting_.counts.repair_data;
    const std::uint64_t needless = found.needless();
    std::string sentence = fmt::format(
        "{} of {} repairs ({}) are of DATA that had been sent to this reader before and was still "
        "under way when it asked",
        grouped(needless), grouped(all), percent_of(needless, all));
    if (found.acknowledged > 0) {
      sentence += fmt::format("; {} of them left after the reader had acknowledged it",
                              grouped(found.acknowledged));
    }
    add("needless_repairs", needless, sentence + ".",
        "a longer time until readers ask, or until the writer answers");
    add("loss", found.lost,
        fmt::format("{} of {} repairs ({}) replace DATA that was lost: the reader asked for it "
                    "although it had what was sent later.",
                    grouped(found.lost), grouped(all), percent_of(found.lost, all)),
        "a better link; no setting of discovery");
    add("forgotten", found.forgotten,
        fmt::format(
            "{} of {} repairs ({}) are for readers that had acknowledged the same before and "
            "begin anew: a lease ended, or a network failed for so long.",
            grouped(found.forgotten), grouped(all), percent_of(found.forgotten, all)),
        "a longer lease than the network fails");
  }

  void readers_that_ask_again() {
    const std::uint64_t initial = counting_.acknacks.initial;
    const std::uint64_t relations = needed_.acknack;
    add("late_replies", beyond(initial, relations) + beyond(of(HeartbeatKind::reply), relations),
        fmt::format("{} initial ACKNACKs for {} relations: readers repeat them because the answer "
                    "comes late, and each repetition is answered again.",
                    grouped(initial), grouped(relations)),
        "a longer interval of initial ACKNACKs, or one that doubles");
  }

  void announcements() {
    const std::uint64_t closed = counting_.unknown_destination;
    add("closed_ports", closed,
        fmt::format("{} went to addresses and ports that no participant in the capture listens on.",
                    plural(closed, "message")),
        "fewer initial peers, or a smaller range of ports");
    const model::Counts& counts = counting_.counts;
    const std::uint64_t sent = counts.spdp_multicast + counts.spdp_unicast;
    const std::uint64_t known = beyond(sent, closed);
    add("announcements", beyond(known, needed_.spdp_multicast + needed_.spdp_unicast),
        fmt::format("{} announcements of participants; {} would introduce everybody.",
                    grouped(known), grouped(needed_.spdp_multicast + needed_.spdp_unicast)),
        "fewer initial announcements, or a longer period");
  }

  void lookups() {
    const std::uint64_t control = counting_.lookup_messages() - counting_.counts.lookup;
    const std::uint64_t samples =
        counting_.lookup_requests.samples + counting_.lookup_replies.samples;
    std::string sentence = fmt::format(
        "{} copies of {} questions about types and answers, each to every participant, and {} "
        "HEARTBEATs, ACKNACKs and GAPs for them: who does not know the type of an endpoint asks "
        "before it matches.",
        grouped(counting_.counts.lookup), grouped(samples), grouped(control));
    const capture::UnknownTypes types = capture::unknown_types(conversation_.topology);
    if (types.most_of_a_participant > 0) {
      sentence += fmt::format(
          " Up to {} of a participant are no other's; asking for what is not "
          "known takes {} copies.",
          plural(types.most_of_a_participant, "type"), grouped(types.lookups));
    }
    add("type_lookups", counting_.lookup_messages(), std::move(sentence),
        "the property fastdds.type_propagation = registration_only of every participant");
  }

  void silence() {
    const Silence found = find_silence(conversation_, counting_);
    std::string names;
    for (const std::size_t k : found.participants) {
      names += (names.empty() ? "" : ", ") + std::to_string(k);
    }
    add("deaf_participant", found.messages,
        fmt::format("{} ({}) acknowledged nothing, though {} were sent to it: it does not hear, is "
                    "gone, or cannot answer.",
                    plural(found.participants.size(), "participant"), names,
                    plural(found.messages, "message")),
        "look at this participant's network interface, firewall and lease");
  }

  static std::string percent_of(std::uint64_t part, std::uint64_t whole) {
    return percent(static_cast<double>(part),
                   static_cast<double>(std::max<std::uint64_t>(whole, 1)));
  }

  const Conversation& conversation_;
  const Counting& counting_;
  const model::Counts& needed_;
  std::vector<Cause> causes_;
};

}  // namespace

std::vector<Cause> causes(const Conversation& conversation, const Counting& counting,
                          const model::Counts& failure_free) {
  return Diagnosis{conversation, counting, failure_free}.run();
}

}  // namespace stormproof::doctor
