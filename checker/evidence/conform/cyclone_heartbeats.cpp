// HEARTBEATs of a writer of Cyclone DDS: answers name their reader and need an ACKNACK of it each;
// of all others, one comes an interval after the other while somebody is behind. One that names its
// reader can be either, so all ways to tell them apart are followed at once.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/cyclone.hpp"
#include "checker/evidence/conform/cyclone_sent.hpp"
#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/ways.hpp"
#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform::cyclone {

namespace {

namespace pacer = fsm::heartbeat_pacer;
using Pacer = Tally<fsm::HeartbeatPacer>;

struct Way : Telling {
  std::int64_t last_ns = 0;  ///< when the timer sent for the last time, earliest
  bool has_sent = false;     ///< the timer
};

class Heartbeats {
 public:
  Heartbeats(const Context& context, const WriterRelations& writer, Ledger& ledger)
      : context_{context},
        bounds_{context.bounds},
        sedp_{context.dds.sedp},
        writer_{writer},
        source_{writer.place().source},
        pacer_{ledger.machines.cyclone.of<fsm::HeartbeatPacer>()},
        ledger_{ledger} {}

  std::optional<Unexplained> explain() {
    if (auto fault = gather(context_, writer_, sent_)) return fault;
    if (auto fault = overdue(context_, writer_, sent_)) return fault;
    if (sent_.empty()) return std::nullopt;
    return causes();
  }

 private:
  std::optional<Unexplained> causes() {
    const auto match_ns = first_match();
    if (!match_ns) {
      return unexplained_in(writer_, sent_.front(), Fault::not_announced,
                            "HEARTBEAT before any reader can be known",
                            "no announcement of another participant is in the capture", {});
    }
    Way first;
    first.next_ns = first_expiry(*match_ns);
    first.answered.resize(writer_.relations.size());
    std::vector<Way> ways{std::move(first)};
    for (const SentHeartbeat& one : sent_) {
      std::vector<Way> next;
      const bool is_answer =
          one.is_named() && answer(ways, *one.receivers.begin(), causes_of(one), next);
      const bool is_timed = fire(ways, one, next);
      const bool is_on_write = next.empty() && one.is_behind_data && !one.is_named();
      if (is_on_write) next = ways;
      if (next.empty()) return without_cause(ways, one);
      ways = some(best(std::move(next)));
      if (is_answer) {
        ledger_.explained(Rule::heartbeat_answer, sends::cyclone::answer, one.events.size());
      } else if (is_timed) {
        ledger_.explained(Rule::heartbeat_periodic, sends::cyclone::expiry, one.events.size());
      } else {
        ledger_.explained(Rule::heartbeat_on_write, {}, one.events.size());
      }
    }
    return std::nullopt;
  }

  /// The timer goes by the match, or by what is created then.
  std::int64_t first_expiry(std::int64_t match_ns) {
    const fsm::Stepper<fsm::HeartbeatPacer>::Input input{
        .now = match_ns,
        .interval = sedp_.heartbeat_interval.count(),
        .match_delay = sedp_.match_heartbeat_delay.count()};
    fsm::StateId state = Pacer::Fly::initial;
    const std::int64_t by_match = pacer_.step<pacer::Matched>(state, input).next_at;
    return std::min(by_match, pacer_.step<pacer::Hastened>(state, input).next_at);
  }

  /// When the writer can have its first reader.
  [[nodiscard]] std::optional<std::int64_t> first_match() const {
    const auto& participants = context_.dialogue.conversation.topology.participants;
    std::optional<std::int64_t> first;
    for (std::size_t j = 0; j < participants.size(); ++j) {
      if (j == source_) continue;
      auto known = known_since(context_.dialogue, source_, j, bounds_);
      // A neighbour that has heard of this participant answers it, before it announces itself.
      if (participants[j].host == participants[source_].host) {
        const auto by_answer = known_since(context_.dialogue, j, source_, bounds_);
        if (by_answer && (!known || *by_answer < *known)) known = by_answer;
      }
      if (known && (!first || *known < *first)) first = known;
    }
    return first;
  }

  /// How many ACKNACKs of its reader it can be the answer to.
  [[nodiscard]] std::size_t causes_of(const SentHeartbeat& one) const {
    return context_.arrived(
        *writer_.relations[*one.receivers.begin()], one.time_ns,
        [](const Answer& acknack) { return acknack.is_initial || !acknack.missing.empty(); });
  }

  /// By the timer. Matches, DATA and requests that the capture does not show may have begun the
  /// interval anew, so it is the shortest.
  bool fire(const std::vector<Way>& ways, const SentHeartbeat& one, std::vector<Way>& next) {
    bool any = false;
    for (const Way& way : ways) {
      if (way.next_ns > one.time_ns + capture_resolution_ns) continue;
      fsm::StateId state = fsm::Reflect<fsm::HeartbeatPacer>::id<pacer::Pacing>;
      const std::int64_t now = std::max(way.next_ns, one.time_ns - bounds_.most_send_lag_ns);
      const auto output =
          pacer_.step<pacer::Fired>(state, {.waiting = true,
                                            .sent_before = way.has_sent,
                                            .now = now,
                                            .last_sent = way.last_ns,
                                            .number = 0,
                                            .interval = sedp_.heartbeat_interval.count(),
                                            .interval_max = sedp_.heartbeat_interval_max.count(),
                                            .match_delay = sedp_.match_heartbeat_delay.count()});
      if (!output.send) continue;
      ledger_.used_lag(now - one.time_ns);
      next.push_back(way);
      next.back().last_ns = now;
      next.back().next_ns = output.next_at;
      next.back().has_sent = true;
      any = true;
    }
    return any;
  }

  static std::vector<Way> some(std::vector<Way> ways) {
    if (ways.size() > most_ways) return {together(ways)};
    return ways;
  }
  /// What any of them allows, it allows.
  static Way together(const std::vector<Way>& ways) {
    Way all = ways.front();
    for (const Way& way : ways) {
      if (way.next_ns < all.next_ns) {
        all.last_ns = way.last_ns;
        all.next_ns = way.next_ns;
        all.has_sent = way.has_sent;
      }
      for (std::size_t r = 0; r < all.answered.size(); ++r) {
        all.answered[r] = std::min(all.answered[r], way.answered[r]);
      }
    }
    return all;
  }

  Unexplained without_cause(const std::vector<Way>& ways, const SentHeartbeat& one) {
    const std::int64_t early = earliest(ways) - one.time_ns;
    return unexplained_in(
        writer_, one, Fault::heartbeat_cause,
        fmt::format("HEARTBEAT {} {} before its timer is due", one.heartbeat.count,
                    duration(early)),
        one.is_named() ? "no ACKNACK of its reader that it answers can have arrived"
                       : fmt::format("one to all readers comes {} after the other",
                                     duration(sedp_.heartbeat_interval.count())),
        {{"send lag", bounds_.most_send_lag_ns + early, bounds_.most_send_lag_ns}});
  }

  static constexpr std::size_t most_ways = 64;

  const Context& context_;
  const Bounds& bounds_;
  const model::SedpProfile& sedp_;
  const WriterRelations& writer_;
  std::size_t source_;
  Pacer& pacer_;
  Ledger& ledger_;
  std::vector<SentHeartbeat> sent_;
};

}  // namespace

std::optional<Unexplained> explain_heartbeats(const Context& context, const WriterRelations& writer,
                                              Ledger& ledger) {
  return Heartbeats{context, writer, ledger}.explain();
}

}  // namespace stormproof::conform::cyclone
