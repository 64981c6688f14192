// HEARTBEATs of a relay. Each announces the whole history, so by their counts the first number
// never falls, and the last falls only if what it leaves out has been acknowledged. One alone opens
// the relation, answers an initial ACKNACK, or comes from the timer of the writer, which goes to
// all readers that lack something: all ways to tell these apart are followed at once.
#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/server_relay.hpp"
#include "checker/evidence/conform/timers.hpp"
#include "checker/evidence/conform/ways.hpp"

namespace stormproof::conform::server {

namespace {

struct Way : Telling {
  std::int64_t expired_ns = INT64_MIN;  ///< when the timer sent for the last time, earliest

  [[nodiscard]] bool is_as_good_as(const Way& other) const {
    return expired_ns == other.expired_ns && Telling::is_as_good_as(other);
  }
};

class Heartbeats {
 public:
  Heartbeats(const Context& context, const WriterRelations& relay,
             const std::vector<Passed>& passed, Ledger& ledger)
      : context_{context},
        bounds_{context.bounds},
        relay_{relay},
        passed_{passed},
        ledger_{ledger},
        period_ns_{context.dds.sedp.heartbeat_period.count()},
        is_opened_(relay.relations.size()) {
    for (const Passed& one : passed) {
      if (one.change) by_change_.emplace(*one.change, &one);
    }
  }

  std::optional<Unexplained> explain() {
    if (auto fault = check_counts()) return fault;
    if (auto fault = check_ranges()) return fault;
    if (auto fault = causes()) return fault;
    for (std::size_t r = 0; r < relay_.relations.size(); ++r) {
      if (auto fault = check_due(r)) return fault;
    }
    return std::nullopt;
  }

 private:
  std::optional<Unexplained> check_counts() {
    const Passed* highest = nullptr;
    for (const Passed& one : passed_) {
      if (!one.heartbeat) continue;
      const auto [same, is_new] = by_count_.emplace(one.heartbeat->count, &one);
      const bool is_late = highest != nullptr && one.heartbeat->count < highest->heartbeat->count &&
                           one.time_ns > highest->time_ns + bounds_.most_send_lag_ns;
      if (!is_new || is_late) {
        return fault(one, Fault::heartbeat_count,
                     fmt::format("HEARTBEAT {} after HEARTBEAT {}", one.heartbeat->count,
                                 highest->heartbeat->count),
                     "the server counts the HEARTBEATs of a relay up, whomever they are for");
      }
      if (highest == nullptr || one.heartbeat->count > highest->heartbeat->count) highest = &one;
    }
    return std::nullopt;
  }

  std::optional<Unexplained> check_ranges() {
    const Heartbeat* before = nullptr;
    std::uint32_t given = 0;  // the highest number until now
    for (const auto& [count, one] : by_count_) {
      const Heartbeat& now = *one->heartbeat;
      // An empty history ends before the next number that there will be.
      const bool is_empty = now.first == now.announced + std::int64_t{1};
      const bool shrinks =
          before != nullptr &&
          (now.first < before->first ||
           (!is_empty && now.announced > before->announced && now.announced <= given));
      const bool is_range = now.first >= 1 && now.first <= now.announced + std::int64_t{1};
      const std::int64_t least = one->change        ? *one->change + std::int64_t{1}
                                 : one->gap.empty() ? now.first
                                                    : one->gap.front() + std::int64_t{1};
      const std::int64_t most = one->change ? least : 0;
      if (shrinks || !is_range || now.first > least || now.announced < most) {
        return range_fault(
            *one, before == nullptr
                      ? "it announces the whole history, in which what is sent is"
                      : fmt::format("it announces the whole history, which was {} to {} before",
                                    before->first, before->announced));
      }
      if (before != nullptr && now.announced < before->announced) {
        if (auto fault = check_left_out(*one, before->announced)) return fault;
      }
      given = std::max(given, now.announced);
      before = &now;
    }
    return std::nullopt;
  }

  /// What is announced no more though the one before did has left the history: whoever was sent it
  /// has acknowledged it.
  std::optional<Unexplained> check_left_out(const Passed& one, std::uint32_t announced) const {
    const auto end = by_change_.lower_bound(announced);
    for (auto at = by_change_.lower_bound(one.heartbeat->announced); at != end; ++at) {
      const auto& [change, sent] = *at;
      if (sent->time_ns > one.time_ns) continue;
      const auto has_it = [&](const Answer& answer) {
        return answer.base > change && context_.can_precede(answer.time_ns, one.time_ns);
      };
      if (std::ranges::any_of(relay_.relations[sent->relation]->answers, has_it)) continue;
      return range_fault(
          one,
          fmt::format("DATA {} stays in the history until its client acknowledges it", change + 1));
    }
    return std::nullopt;
  }

  std::optional<Unexplained> causes() {
    Way first;
    first.answered.resize(relay_.relations.size());
    std::vector<Way> ways{std::move(first)};
    for (const Passed& one : passed_) {
      if (!one.heartbeat) continue;
      if (!one.is_alone()) {
        is_opened_[one.relation] = true;
        ledger_.explained(Rule::relay_heartbeat,
                          one.change ? sends::server::served : sends::server::skipped);
      } else if (!is_opened_[one.relation]) {
        open(ways, one);
      } else if (auto fault = alone(ways, one)) {
        return fault;
      }
    }
    return std::nullopt;
  }

  void open(std::vector<Way>& ways, const Passed& one) {
    is_opened_[one.relation] = true;
    ledger_.explained(Rule::relay_open);
    // A client that nobody sees may have armed the timer before.
    if (may_be_hidden()) return;
    for (Way& way : ways) {
      if (way.next_ns == INT64_MIN) way.next_ns = earliest(one) + period_ns_;
    }
  }

  std::optional<Unexplained> alone(std::vector<Way>& ways, const Passed& one) {
    std::vector<Way> next;
    const std::size_t asked = context_.arrived(*relay_.relations[one.relation], one.time_ns,
                                               std::mem_fn(&Answer::is_initial));
    const bool is_reply = answer(ways, one.relation, asked, next);
    const bool is_expiry = expire(ways, one, next);
    if (next.empty()) return without_cause(ways, one);
    ways = best(std::move(next));
    ledger_.explained(is_reply || !is_expiry ? Rule::relay_reply : Rule::relay_periodic);
    return std::nullopt;
  }

  bool expire(const std::vector<Way>& ways, const Passed& one, std::vector<Way>& next) const {
    bool any = false;
    for (const Way& way : ways) {
      const bool is_same = way.expired_ns > INT64_MIN &&
                           one.time_ns - way.expired_ns <= 2 * bounds_.most_send_lag_ns;
      if (!is_same && way.next_ns > one.time_ns + capture_resolution_ns) continue;
      any = true;
      next.push_back(way);
      if (is_same) continue;
      next.back().expired_ns = std::max(way.next_ns, earliest(one));
      next.back().next_ns = next.back().expired_ns + period_ns_;
    }
    return any;
  }

  /// A client that has acknowledged nothing of what was there when the relation opened lacks it
  /// when the timer expires, which it does within its period.
  std::optional<Unexplained> check_due(std::size_t r) const {
    const Relation& relation = *relay_.relations[r];
    if (relation.sent.empty() || !relation.sent.front().heartbeat) return std::nullopt;
    const Submessage& opening = relation.sent.front();
    if (opening.heartbeat->announced + std::int64_t{1} == opening.heartbeat->first) {
      return std::nullopt;  // the history is empty
    }
    const std::int64_t until = surely_after(bounds_, opening.time_ns + period_ns_);
    if (until >= context_.dialogue.end_ns) return std::nullopt;
    for (const Answer& answer : relation.answers) {
      if (!answer.is_initial && answer.time_ns <= until) return std::nullopt;
    }
    const auto next = std::ranges::find_if(relation.sent, [&](const Submessage& one) {
      return one.heartbeat && one.event != opening.event;
    });
    if (next != relation.sent.end() && next->time_ns <= until) return std::nullopt;
    const Submessage& at = next == relation.sent.end() ? opening : *next;
    return conform::unexplained_in(
        relation, at.event, Fault::heartbeat_due,
        fmt::format("no HEARTBEAT within {} after the relation opened, though the client has "
                    "acknowledged nothing",
                    duration(until - opening.time_ns)),
        fmt::format("the server's timer expires every {}", duration(period_ns_)),
        {{"lateness", {}, bounds_.most_lateness_ns}});
  }

  Unexplained without_cause(const std::vector<Way>& ways, const Passed& one) const {
    const std::int64_t early = conform::earliest(ways) - one.time_ns;
    return unexplained_in(
        relay_, one, one.event, Fault::heartbeat_cause,
        fmt::format("HEARTBEAT {} {} before the timer is due", one.heartbeat->count,
                    duration(early)),
        "no initial ACKNACK of its client that it answers can have arrived, and the timer expires "
        "once in its period",
        {{"send lag", bounds_.most_send_lag_ns + early, bounds_.most_send_lag_ns}});
  }
  [[nodiscard]] Unexplained range_fault(const Passed& one, std::string nearest) const {
    const Heartbeat& said = *one.heartbeat;
    return fault(
        one, Fault::heartbeat_range,
        fmt::format("HEARTBEAT {} announces {} to {}", said.count, said.first, said.announced),
        std::move(nearest));
  }
  Unexplained fault(const Passed& one, Fault kind, std::string what, std::string nearest) const {
    return unexplained_in(relay_, one, one.heartbeat_event, kind, std::move(what),
                          std::move(nearest));
  }

  [[nodiscard]] std::int64_t earliest(const Passed& one) const {
    return one.time_ns - bounds_.most_send_lag_ns;
  }
  [[nodiscard]] bool may_be_hidden() const {
    return context_.dialogue.has_neighbour[relay_.place().source];
  }

  const Context& context_;
  const Bounds& bounds_;
  const WriterRelations& relay_;
  const std::vector<Passed>& passed_;
  Ledger& ledger_;
  const std::int64_t period_ns_;
  std::vector<bool> is_opened_;  ///< by relation
  std::map<std::uint32_t, const Passed*> by_count_;
  std::multimap<std::uint32_t, const Passed*> by_change_;
};

}  // namespace

std::optional<Unexplained> explain_heartbeats(const Context& context, const WriterRelations& relay,
                                              const std::vector<Passed>& passed, Ledger& ledger) {
  return Heartbeats{context, relay, passed, ledger}.explain();
}

}  // namespace stormproof::conform::server
