// Which timers of participants with an event thread go on, as an observer sees them: one is under
// way if it is scheduled and its event is pending, or if it is on the list of a thread that runs.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "model/event.hpp"
#include "model/probe.hpp"

namespace stormproof::props {

class ThreadTimers {
 public:
  using EventKind = model::EventKind;

  void reset(std::uint32_t participants, std::uint32_t writers) {
    announcements_.assign(participants, {});
    threads_.assign(participants, {});
    heartbeats_.assign(writers, {});
  }
  void scheduled(EventKind kind, std::uint32_t subject) {
    if (Timer* timer = timer_of(kind, subject)) ++timer->pending;
  }
  void started(const model::Event& event) {
    Timer* const timer = timer_of(event.kind, event.subject);
    if (timer != nullptr && timer->pending > 0) --timer->pending;
  }
  void transition(const model::Transition& fired) {
    const std::uint32_t n = fired.machine.subject;
    if (fired.machine.kind == model::MachineRef::Kind::endpoint_writer) {
      if (fired.machine.machine == "MovableTimer") heartbeats_[n].state = state_named(fired.after);
    } else if (fired.machine.kind == model::MachineRef::Kind::participant) {
      if (fired.machine.machine == "EventThread") threads_[n].state = state_named(fired.after);
      if (fired.machine.machine == "MovableTimer") {
        announcements_[n].state = state_named(fired.after);
      }
    }
  }

  /// Whether the participant will announce itself.
  [[nodiscard]] bool announces(std::uint32_t i) const { return goes_on(announcements_[i], i); }
  /// Whether participant i will send a HEARTBEAT of its writer.
  [[nodiscard]] bool heartbeats(std::uint32_t writer, std::uint32_t i) const {
    return goes_on(heartbeats_[writer], i);
  }

 private:
  /// Of a timer, which may be idle, or of a thread.
  enum class State : std::uint8_t { idle, scheduled, listed, awake };
  struct Timer {
    std::uint64_t pending = 0;  ///< events
    State state = State::idle;
  };

  static State state_named(std::string_view name) {
    if (name == "Scheduled") return State::scheduled;
    if (name == "Listed") return State::listed;
    return name == "Asleep" || name == "Idle" ? State::idle : State::awake;
  }
  Timer* timer_of(EventKind kind, std::uint32_t subject) {
    if (kind == EventKind::spdp_time) return &announcements_[subject];
    if (kind == EventKind::thread_run) return &threads_[subject];
    return kind == EventKind::heartbeat_time ? &heartbeats_[subject] : nullptr;
  }
  [[nodiscard]] bool goes_on(const Timer& timer, std::uint32_t i) const {
    if (timer.state == State::scheduled) return timer.pending > 0;
    const Timer& thread = threads_[i];
    return timer.state == State::listed && thread.state == State::awake && thread.pending > 0;
  }

  // By participant, and of writers.
  std::vector<Timer> announcements_;
  std::vector<Timer> threads_;  ///< their runs
  std::vector<Timer> heartbeats_;
};

}  // namespace stormproof::props
