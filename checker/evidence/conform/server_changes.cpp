// What the DATA of a relay say. A change has one number at a time, in the order in which the
// routine decided to pass it on; a new number takes the place of the old one. What is passed on the
// server has got, and has to tell this client; of descriptors only when its routine has noticed
// that the client has acknowledged their participant.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/server_knowledge.hpp"
#include "checker/evidence/conform/server_relay.hpp"

namespace stormproof::conform::server {

namespace {

class Changes {
 public:
  Changes(const Context& context, const WriterRelations& relay, const std::vector<Passed>& passed,
          Ledger& ledger)
      : context_{context}, relay_{relay}, passed_{passed}, ledger_{ledger}, knowledge_{context} {}

  std::optional<Unexplained> check() {
    for (const Passed& one : passed_) {
      if (!one.change) continue;
      if (auto fault = one.heartbeat ? check(one) : answer(one)) return fault;
    }
    return std::nullopt;
  }

 private:
  std::optional<Unexplained> check(const Passed& one) {
    const auto item = knowledge_.item_of(context_.dialogue.conversation.events[one.event]);
    if (!item) return std::nullopt;
    if (auto fault = check_number(one, *item)) return fault;
    if (auto fault = check_own(one, *item)) return fault;
    if (auto fault = check_times(one, *item)) return fault;
    return check_cause(one, *item);
  }

  /// Only the server's own announcement goes without a HEARTBEAT: once, as an answer to a client
  /// that knows it by its locator.
  std::optional<Unexplained> answer(const Passed& one) {
    const auto item = knowledge_.item_of(context_.dialogue.conversation.events[one.event]);
    const bool is_own = item && *item == Item{*context_.dialogue.server};
    const bool is_answer = is_own && context_.dds.server.known == model::ServerKnown::locator &&
                           answered_.insert(one.relation).second;
    if (is_answer) {
      ledger_.explained(Rule::relay_answer);
      const bool is_super = context_.dds.discovery == model::Discovery::super_client;
      return is_super || *one.change == 0 ? check_number(one, *item) : check_own(one, *item);
    }
    return fault(one, Fault::data_cause,
                 fmt::format("DATA {} without a HEARTBEAT", *one.change + 1),
                 "the server sends each change with a HEARTBEAT");
  }

  std::optional<Unexplained> check_number(const Passed& one, const Item& item) {
    const auto known = items_.emplace(*one.change, item).first;
    auto& numbers = numbers_[item];
    numbers.insert(*one.change);
    if (known->second != item) {
      return fault(one, Fault::data_cause,
                   fmt::format("DATA {}, which was another change before", *one.change + 1),
                   "a number stands for one change");
    }
    const auto newer = latest_.find(item);
    if (newer != latest_.end() && newer->second.number > *one.change &&
        one.time_ns > newer->second.time_ns + context_.bounds.most_send_lag_ns) {
      return fault(
          one, Fault::data_cause,
          fmt::format("DATA {}, which has become {}", *one.change + 1, newer->second.number + 1),
          "what gets a new number is sent with that one only");
    }
    if (newer == latest_.end() || newer->second.number < *one.change) {
      latest_[item] = {*one.change, one.time_ns};
    }
    return std::nullopt;
  }

  /// The server's own announcement is number 1. When a super client comes it is sent again, before
  /// anybody has been sent it.
  std::optional<Unexplained> check_own(const Passed& one, const Item& item) const {
    const bool is_own = item.participant == *context_.dialogue.server;
    const bool is_super = context_.dds.discovery == model::Discovery::super_client;
    if (!is_own || (*one.change == 0) != is_super) return std::nullopt;
    return fault(one, Fault::data_cause,
                 fmt::format("the server's own announcement as DATA {}", *one.change + 1),
                 is_super ? "it gets a new number for each super client"
                          : "only for super clients it is sent again");
  }

  /// With `relay: once` a change gets a number for each client at most.
  std::optional<Unexplained> check_times(const Passed& one, const Item& item) const {
    if (context_.dds.server.relay != model::Relay::once) return std::nullopt;
    const bool is_own = item.participant == *context_.dialogue.server;
    const std::size_t most = context_.dialogue.participants() - (is_own ? 0 : 2);
    const std::size_t times = numbers_.at(item).size();
    if (times <= most) return std::nullopt;
    return fault(one, Fault::data_cause,
                 fmt::format("DATA {}, number {} of the same change", *one.change + 1, times),
                 fmt::format("with `relay: once` it gets one for each client, {} at most", most));
  }

  std::optional<Unexplained> check_cause(const Passed& one, const Item& item) const {
    const std::size_t client = *relay_.relations[one.relation]->place.destination;
    const std::int64_t from = knowledge_.passes_on(item, client);
    if (from == always_ns || from <= one.time_ns + capture_resolution_ns) return std::nullopt;
    const bool is_descriptor = item.endpoint != 0;
    if (from == never_ns) {
      return fault(one, Fault::data_cause, what_of(one, is_descriptor),
                   is_descriptor ? "the client has not acknowledged its participant, or needs "
                                   "nothing on its topic"
                                 : "the client needs nothing of this participant");
    }
    return fault(one, Fault::data_early, what_of(one, is_descriptor),
                 fmt::format("the server can know that it has to at the earliest {} later",
                             duration(from - one.time_ns)),
                 {{"clock error", from - one.time_ns + context_.bounds.clock_error_ns,
                   context_.bounds.clock_error_ns}});
  }
  static std::string what_of(const Passed& one, bool is_descriptor) {
    return fmt::format("DATA {}, {} that the client need not have", *one.change + 1,
                       is_descriptor ? "a descriptor" : "an announcement");
  }

  [[nodiscard]] Unexplained fault(const Passed& one, Fault kind, std::string what,
                                  std::string nearest, std::vector<Need> needs = {}) const {
    return unexplained_in(relay_, one, one.event, kind, std::move(what), std::move(nearest),
                          std::move(needs));
  }

  struct Latest {
    std::uint32_t number = 0;
    std::int64_t time_ns = 0;
  };
  const Context& context_;
  const WriterRelations& relay_;
  const std::vector<Passed>& passed_;
  Ledger& ledger_;
  const ServerKnowledge knowledge_;
  std::map<std::uint32_t, Item> items_;
  std::map<Item, std::set<std::uint32_t>> numbers_;
  std::map<Item, Latest> latest_;
  std::set<std::size_t> answered_;  ///< relations
};

}  // namespace

std::optional<Unexplained> check_changes(const Context& context, const WriterRelations& relay,
                                         const std::vector<Passed>& passed, Ledger& ledger) {
  return Changes{context, relay, passed, ledger}.check();
}

}  // namespace stormproof::conform::server
