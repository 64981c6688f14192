// What the two models of a relation share: the parts of a state as slices of one list of
// expressions, the reader machine, the HEARTBEAT timer, and sums of outputs.
#pragma once

#include <string>
#include <vector>

#include "checker/engines/tables/commutation_matrix.hpp"
#include "checker/engines/tables/machine_step.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"

namespace stormproof::tables {

using ReaderStep = MachineStep<fsm::DiscoveryReader>;
using TimerStep = MachineStep<fsm::HeartbeatTimer>;
using InitialStep = MachineStep<fsm::InitialAckNack>;

[[nodiscard]] inline Expr constant(bool value) {
  return smt::SymbolicContext::current().bool_val(value);
}
[[nodiscard]] inline Expr truth(const std::string& name) {
  return smt::SymbolicBool::named(name).expr();
}
[[nodiscard]] inline Expr count(const Expr& condition) {
  z3::context& context = smt::SymbolicContext::current();
  return z3::ite(condition, context.int_val(1), context.int_val(0));
}

/// What an event emits and schedules, by the position of the output in the relation's list.
class Outputs {
 public:
  explicit Outputs(std::size_t kinds) {
    counts_.assign(kinds, smt::SymbolicContext::current().int_val(0));
  }
  void add(std::size_t kind, const Expr& condition) {
    counts_[kind] = counts_[kind] + count(condition);
  }
  [[nodiscard]] const Exprs& counts() const { return counts_; }

 private:
  Exprs counts_;
};

/// The periodic HEARTBEAT timer of the writer: its state and the number of pending expiries.
struct TimerPart {
  OneHot state;
  Expr pending;

  static TimerPart unknown() {
    return {TimerStep::unknown_state("timer="), smt::SymbolicInt::named("pending").expr()};
  }
  /// Lets the timer process `Event` if `when`; returns what it asks for.
  template <class Event>
  TimerStep::Effect step(const TimerStep& machine, const Expr& additive, const Expr& unacknowledged,
                         const Expr& when) {
    TimerStep::Input input;
    input.additive = smt::SymbolicBool{additive};
    input.pending = smt::SymbolicInt{pending};
    input.unacknowledged = smt::SymbolicBool{unacknowledged};
    auto effect = machine.step<Event>(state, input, when);
    state = effect.next;
    pending = pending + count(effect.asks(&TimerStep::Output::schedule_expiry));
    return effect;
  }
  [[nodiscard]] Expr possible() const { return exactly_one(state) && pending >= 0; }
  /// Of runs with the periodic policy.
  [[nodiscard]] Expr consistent() const {
    namespace timer = fsm::heartbeat_timer;
    const Expr& armed = TimerStep::is<timer::Armed>(state);
    return (armed || TimerStep::is<timer::Idle>(state)) && armed == (pending >= 1);
  }
};

/// The reader side as far as one descriptor sees it.
struct ReaderPart {
  OneHot state;
  Expr received;        ///< X of the descriptor
  Expr others_missing;  ///< some other descriptor has X = 0
  Expr heartbeat_seen;

  static ReaderPart unknown() {
    return {ReaderStep::unknown_state("reader="), truth("received"), truth("others_missing"),
            truth("heartbeat_seen")};
  }
  /// DATA that carries the descriptor or not, and completes the others or not. Returns whether it
  /// is taken.
  Expr take_data(const ReaderStep& machine, const Expr& accepts, const Expr& carries,
                 const Expr& completes_others) {
    const Expr received_after = received || carries;
    const Expr others_after = others_missing && !completes_others;
    const Expr missing_after = count(!received_after) + count(others_after);
    const auto effect = machine.step<fsm::discovery_reader::DataReceived>(
        state,
        {.accepts_unmatched = smt::SymbolicBool{accepts},
         .missing_after = smt::SymbolicInt{missing_after}},
        constant(true));
    const Expr taken = effect.asks(&ReaderStep::Output::take_data);
    state = effect.next;
    received = z3::ite(taken, received_after, received);
    others_missing = z3::ite(taken, others_after, others_missing);
    return taken;
  }
  /// A HEARTBEAT if `when`. Returns whether an ACKNACK is to be scheduled.
  Expr take_heartbeat(const ReaderStep& machine, const Expr& accepts, const Expr& when) {
    const auto effect = machine.step<fsm::discovery_reader::HeartbeatReceived>(
        state, {.accepts_unmatched = smt::SymbolicBool{accepts}, .missing_after = 0}, when);
    const Expr schedules = effect.asks(&ReaderStep::Output::schedule_acknack);
    state = effect.next;
    heartbeat_seen = heartbeat_seen || schedules;
    return schedules;
  }
  [[nodiscard]] Expr possible() const { return exactly_one(state); }
  [[nodiscard]] Expr consistent() const {
    namespace reader = fsm::discovery_reader;
    const Expr complete =
        ReaderStep::is<reader::Complete>(state) || ReaderStep::is<reader::EarlyComplete>(state);
    return complete == (received && !others_missing);
  }
};

/// Takes consecutive values out of a flat state.
class Reading {
 public:
  explicit Reading(const Exprs& flat) : flat_{flat} {}
  Expr one() { return flat_[next_++]; }
  OneHot many(std::size_t size) {
    OneHot part;
    for (std::size_t k = 0; k < size; ++k) part.push_back(one());
    return part;
  }

 private:
  const Exprs& flat_;
  std::size_t next_ = 0;
};

inline void append(Exprs& flat, const Exprs& part) {
  flat.insert(flat.end(), part.begin(), part.end());
}

}  // namespace stormproof::tables
