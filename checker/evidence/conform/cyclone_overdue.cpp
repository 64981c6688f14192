// While a reader on another host surely waits, the HEARTBEAT timer of its writer goes on.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/conform/cyclone_sent.hpp"
#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/timers.hpp"

namespace stormproof::conform::cyclone {

namespace {

namespace pacer = fsm::heartbeat_pacer;

class Overdue {
 public:
  Overdue(const Context& context, const WriterRelations& writer,
          const std::vector<SentHeartbeat>& sent)
      : context_{context},
        bounds_{context.bounds},
        sedp_{context.dds.sedp},
        writer_{writer},
        source_{writer.place().source},
        sent_{sent} {}

  std::optional<Unexplained> find() const {
    for (std::size_t k = 0; k < sent_.size(); ++k) {
      const SentHeartbeat& one = sent_[k];
      if (one.is_named() || one.is_multicast || one.is_behind_data) continue;
      const std::int64_t interval = longest_interval_after(one);
      const std::int64_t due = one.time_ns + interval * (can_match_after(one.time_ns) ? 2 : 1);
      const std::int64_t until = surely_after(bounds_, due);
      if (until >= context_.dialogue.end_ns) continue;
      // Copies of one packet are apart.
      const bool goes_on = std::ranges::any_of(sent_, [&](const SentHeartbeat& other) {
        return other.heartbeat.count != one.heartbeat.count && other.time_ns >= one.time_ns &&
               other.time_ns <= until;
      });
      if (goes_on) continue;
      for (const std::size_t r : one.receivers) {
        if (!surely_waits(r, one, until)) continue;
        return unexplained_in(
            writer_, one, Fault::heartbeat_due,
            fmt::format("no HEARTBEAT follows HEARTBEAT {} for {}", one.heartbeat.count,
                        duration(until - one.time_ns)),
            fmt::format("a reader has not acknowledged what there is, so the next one is "
                        "due after {} at most",
                        duration(due - one.time_ns)),
            {{"lateness", {}, bounds_.most_lateness_ns}});
      }
    }
    return std::nullopt;
  }

 private:
  /// Each HEARTBEAT so far may have made it longer.
  [[nodiscard]] std::int64_t longest_interval_after(const SentHeartbeat& one) const {
    fsm::Stepper<fsm::HeartbeatPacer> machine;
    fsm::StateId state = fsm::Reflect<fsm::HeartbeatPacer>::id<pacer::Pacing>;
    const std::int64_t number = std::max<std::int64_t>(one.heartbeat.count, 1) - 1;
    return machine
        .step<pacer::Fired>(state, {.waiting = true,
                                    .sent_before = false,
                                    .now = 0,
                                    .last_sent = 0,
                                    .number = number,
                                    .interval = sedp_.heartbeat_interval.count(),
                                    .interval_max = sedp_.heartbeat_interval_max.count(),
                                    .match_delay = sedp_.match_heartbeat_delay.count()})
        .next_at;
  }

  /// Whether another reader may be matched after this time: then the HEARTBEAT may be put off once.
  [[nodiscard]] bool can_match_after(std::int64_t time_ns) const {
    const auto& participants = context_.dialogue.conversation.topology.participants;
    const auto& events = context_.dialogue.conversation.events;
    for (std::size_t j = 0; j < participants.size(); ++j) {
      if (j == source_) continue;
      if (participants[j].host == participants[source_].host) {
        const auto known = known_since(context_.dialogue, source_, j, bounds_);
        if (!known || *known + bounds_.most_same_host_ns > time_ns) return true;
        continue;
      }
      // Who is written to is matched.
      const auto written = std::ranges::find_if(events, [&](const capture::Event& event) {
        return event.source == participants[source_].prefix && !event.is_multicast &&
               event.destination == participants[j].prefix;
      });
      if (written == events.end() || written->time_ns > time_ns) return true;
    }
    return false;
  }

  /// Whether the writer cannot know by then that the reader has everything that it announced: it
  /// counts as having what existed when it was matched, and what its ACKNACKs say.
  [[nodiscard]] bool surely_waits(std::size_t r, const SentHeartbeat& one,
                                  std::int64_t until) const {
    const Relation& relation = *writer_.relations[r];
    std::uint32_t most = UINT32_MAX;
    std::uint32_t first_count = UINT32_MAX;
    for (const Submessage& other : relation.sent) {
      if (!other.heartbeat || other.is_multicast || other.heartbeat->count >= first_count) continue;
      first_count = other.heartbeat->count;
      most = other.heartbeat->announced;
    }
    bool can_have_replied = false;
    for (const Answer& answer : relation.answers) {
      if (answer.time_ns > until) break;
      can_have_replied = can_have_replied || answer.missing.empty();
      most = std::max(most, answer.base);
    }
    return !can_have_replied || most < one.heartbeat.announced;
  }

  const Context& context_;
  const Bounds& bounds_;
  const model::SedpProfile& sedp_;
  const WriterRelations& writer_;
  std::size_t source_;
  const std::vector<SentHeartbeat>& sent_;
};

}  // namespace

std::optional<Unexplained> overdue(const Context& context, const WriterRelations& writer,
                                   const std::vector<SentHeartbeat>& sent) {
  return Overdue{context, writer, sent}.find();
}

}  // namespace stormproof::conform::cyclone
