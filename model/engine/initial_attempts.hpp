// The attempts of a reader to ask by itself: drives the initial ACKNACK timer of any kind of
// relation (the paper's, Fast DDS's, control-only). What an attempt sends is the caller's business.
#pragma once

#include <cstdint>

#include "fsm/initial_acknack.hpp"
#include "model/engine/driver.hpp"

namespace stormproof::model {

/// The timer of one relation.
struct InitialTimer {
  fsm::StateId state = fsm::Flyweight<fsm::InitialAckNack>::initial;
  std::uint8_t attempts = 0;  ///< the current delay is τ_I · 2^attempts; 0 if it is constant
};

class InitialAttempts {
 public:
  /// `due` is the event kind of an attempt; its subject is the relation.
  InitialAttempts(RunState& run, MachineRef::Kind relations, EventKind due)
      : run_{run}, driver_{run, relations}, due_{due} {}

  /// The reader side has opened.
  void open(InitialTimer& timer, std::uint32_t relation) {
    step<fsm::initial_acknack::ReaderOpened>(timer, false, relation, [] {});
  }

  /// An attempt is due: calls `send` unless a HEARTBEAT has been seen, then waits again.
  template <class Send>
  void attempt(InitialTimer& timer, bool heartbeat_seen, std::uint32_t relation, Send&& send) {
    step<fsm::initial_acknack::AttemptDue>(timer, heartbeat_seen, relation, send);
  }

 private:
  static constexpr std::int64_t longest_delay = std::int64_t{1} << 60;

  template <class TimerEvent, class Send>
  void step(InitialTimer& timer, bool heartbeat_seen, std::uint32_t relation, Send&& send) {
    const SedpProfile& sedp = run_.scenario.dds.sedp;
    const std::int64_t first = sedp.initial_acknack_delay.count();
    const bool constant = sedp.initial_acknack_interval == InitialAckNackInterval::constant;
    const auto output = driver_.template step<TimerEvent>(run_, timer.state,
                                                          {.now = run_.now.count(),
                                                           .first_delay = first,
                                                           .last_delay = first << timer.attempts,
                                                           .heartbeat_seen = heartbeat_seen,
                                                           .constant = constant},
                                                          relation);
    if (output.attempt) {
      // Only events that are scheduled twice get near the end of the clock.
      if (!constant && first << timer.attempts < longest_delay) ++timer.attempts;
      send();
    }
    if (output.schedule) run_.schedule(Nanoseconds{output.next_at}, due_, relation);
  }

  RunState& run_;
  Driver<fsm::InitialAckNack> driver_;
  EventKind due_;
};

}  // namespace stormproof::model
