// Drives the HEARTBEAT timers of all writers of a run: what the machine in fsm/heartbeat_timer.hpp
// decides is scheduled and sent here, and the adaptive policy's lists of readers are kept here:
// whom a cycle contacted, who has responded, and the batches in which the silent ones are asked
// again. Who still lacks an acknowledgment, and what a HEARTBEAT is, the implementation says.
#pragma once

#include <cstdint>
#include <vector>

#include "fsm/heartbeat_timer.hpp"
#include "model/engine/driver.hpp"

namespace stormproof::model {

/// What the schedule asks of the implementation whose writers it drives. Writers are 2 ·
/// participant + stream.
class HeartbeatSender {
 public:
  virtual ~HeartbeatSender() = default;

  /// Whether an expiry (periodic policy) or a cycle (adaptive policy) has a reason to send.
  [[nodiscard]] virtual bool needs_heartbeat(std::uint32_t writer) const = 0;
  /// The relations whose readers have not acknowledged everything, ascending.
  [[nodiscard]] virtual std::vector<std::uint32_t> unacknowledged(std::uint32_t writer) const = 0;
  [[nodiscard]] virtual bool is_unacknowledged(std::uint32_t relation) const = 0;
  /// How many descriptors a HEARTBEAT of the writer announces now.
  [[nodiscard]] virtual std::uint32_t announced(std::uint32_t writer) const = 0;
  /// A periodic HEARTBEAT to the recipients of the profile.
  virtual void send_periodic(std::uint32_t writer) = 0;
  /// A HEARTBEAT to one reader.
  virtual void send_heartbeat(std::uint32_t relation) = 0;
};

class HeartbeatSchedule {
 public:
  HeartbeatSchedule(RunState& run, HeartbeatSender& sender);

  /// Something must be checked after τ_H: arms the timer if it is idle.
  void arm(std::uint32_t writer) { step<fsm::heartbeat_timer::ArmRequested>(writer); }
  /// A suppression has ended with something unacknowledged (the paper's rule 6).
  void suppression_ended(std::uint32_t writer) {
    step<fsm::heartbeat_timer::SuppressionEnded>(writer);
  }
  /// A HEARTBEAT expiry, cycle or batch event is due.
  void handle(const Event& event);
  /// A clean ACKNACK of this relation's reader, which has the first `base` descriptors: it counts
  /// once for the cycle that contacted the reader, if that is all that was announced when the cycle
  /// started.
  void response(std::uint32_t writer, std::uint32_t relation, std::uint32_t base);

 private:
  using TimerDriver = Driver<fsm::HeartbeatTimer>;

  struct Cycle {
    Nanoseconds start;
    Nanoseconds period;
    std::uint32_t token = 0;  ///< events with an older token are void
    std::uint32_t responded = 0;
    std::uint32_t announced = 0;           ///< descriptors announced when the cycle started
    std::vector<std::uint32_t> contacted;  ///< relations, ascending
    std::vector<bool> has_responded;       ///< parallel to `contacted`
    std::vector<std::vector<std::uint32_t>> batches;
    std::size_t next_batch = 0;
  };
  struct Timer {
    fsm::StateId state = fsm::Flyweight<fsm::HeartbeatTimer>::initial;
    std::uint32_t pending = 0;  ///< scheduled expiries (periodic policy)
    Cycle cycle;
  };

  template <class TimerEvent>
  void step(std::uint32_t writer, std::size_t responding = 0);
  [[nodiscard]] TimerDriver::Input input(std::uint32_t writer) const;
  void apply_periodic(std::uint32_t writer, const TimerDriver::Output& output);
  void apply_adaptive(std::uint32_t writer, const TimerDriver::Output& output,
                      std::size_t responding);
  void contact(std::uint32_t writer);
  void plan_batches(std::uint32_t writer, Nanoseconds stretched);
  void send_batch(Cycle& cycle);

  RunState& run_;
  HeartbeatSender& sender_;
  const SedpProfile& sedp_;
  const bool adaptive_;
  std::vector<Timer> timers_;
  TimerDriver driver_{run_, MachineRef::Kind::writer};
};

}  // namespace stormproof::model
