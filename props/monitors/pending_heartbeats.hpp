// Which HEARTBEAT timer events of a writer are pending and not void, as an observer sees them.
// Periodic policy: every scheduled expiry until it starts. Adaptive policy: starting a cycle,
// ending it, and the early end by a response make every cycle event void that was scheduled before
// (fsm/heartbeat_timer.hpp); such an event is processed, but does nothing.
//
// The early end shows as a response after which a cycle start is scheduled at once; a response that
// is only counted schedules nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "model/engine/topology.hpp"
#include "model/probe.hpp"

namespace stormproof::props {

class PendingHeartbeats {
 public:
  void reset(const model::Topology& topology) {
    writers_.assign(2 * std::size_t{topology.participant_count()}, {});
  }

  /// Returns whether the event concerns the pending ones of a writer.
  bool scheduled(std::uint64_t insertion, model::EventKind kind, std::uint32_t writer) {
    if (!is_expiry_or_cycle(kind)) return false;
    Writer& w = writers_[writer];
    if (w.ending_early) w.pending.clear();
    w.ending_early = false;
    w.pending.push_back(insertion);
    return true;
  }
  void started(const model::Event& event) {
    if (!is_expiry_or_cycle(event.kind)) return;
    std::erase(writers_[event.subject].pending, event.insertion());
  }
  void rescheduled(const model::Event& event, std::uint64_t insertion) {
    if (!is_expiry_or_cycle(event.kind)) return;
    std::ranges::replace(writers_[event.subject].pending, event.insertion(), insertion);
  }
  void transition(const model::MachineRef& machine, std::string_view event,
                  std::string_view after) {
    if (machine.machine != "HeartbeatTimer") return;
    Writer& w = writers_[machine.subject];
    w.ending_early = event == "ResponseReceived" && after != "Idle";
    const bool ends = event == "CycleStarted" || event == "CycleEnded" ||
                      (event == "ResponseReceived" && after == "Idle");
    if (ends) w.pending.clear();
  }

  /// Pending expiries, or cycle starts and ends that are not void.
  [[nodiscard]] std::size_t count(std::uint32_t writer) const {
    return writers_[writer].pending.size();
  }

 private:
  struct Writer {
    std::vector<std::uint64_t> pending;  // insertion numbers
    bool ending_early = false;
  };
  static bool is_expiry_or_cycle(model::EventKind kind) {
    return kind == model::EventKind::heartbeat_expiry || kind == model::EventKind::cycle_start ||
           kind == model::EventKind::cycle_end;
  }

  std::vector<Writer> writers_;
};

}  // namespace stormproof::props
