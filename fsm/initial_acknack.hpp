// The timer of the initial ACKNACK of one relation: after τ_I without a HEARTBEAT the reader asks
// by itself, and again after twice the delay (or the same one, as some versions of Fast DDS have
// it), until the first HEARTBEAT has been seen.
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct InitialAckNackIo {
  template <class D>
  struct Input {
    typename D::Int now{};          ///< ns
    typename D::Int first_delay{};  ///< τ_I in ns; 0 disables initial ACKNACKs
    typename D::Int last_delay{};   ///< the delay that has just passed, ns
    typename D::Bool heartbeat_seen{};
    typename D::Bool constant{};  ///< the delay stays τ_I instead of doubling
  };
  template <class D>
  struct Output {
    typename D::Bool attempt{};   ///< send an initial ACKNACK now
    typename D::Bool schedule{};  ///< wait for `next_delay`, until `next_at`
    typename D::Int next_delay{};
    typename D::Int next_at{};
  };
};

namespace initial_acknack {

struct Dormant : State {};
struct Waiting : State {};
struct Done : State {};

struct ReaderOpened : Event<InitialAckNackIo> {};
struct AttemptDue : Event<InitialAckNackIo> {};

struct Enabled : Guard<Enabled> {
  template <class D>
  static constexpr typename D::Bool test(const InitialAckNackIo::Input<D>& in) {
    return in.first_delay > 0;
  }
};
struct HeartbeatSeen : Holds<HeartbeatSeen> {
  static constexpr auto& flag(auto& in) { return in.heartbeat_seen; }
};

struct Start : Action<Start> {
  template <class D>
  static constexpr void act(const InitialAckNackIo::Input<D>& in,
                            InitialAckNackIo::Output<D>& out) {
    out.schedule = true;
    out.next_delay = in.first_delay;
    out.next_at = in.now + in.first_delay;
  }
};
struct Retry : Action<Retry> {
  template <class D>
  static constexpr void act(const InitialAckNackIo::Input<D>& in,
                            InitialAckNackIo::Output<D>& out) {
    out.attempt = true;
    out.schedule = true;
    out.next_delay = D::select(in.constant, in.last_delay, in.last_delay + in.last_delay);
    out.next_at = in.now + D::select(in.constant, in.last_delay, in.last_delay + in.last_delay);
  }
};

using Transitions = Table<Row<Dormant, ReaderOpened, Waiting, Start, Enabled>,
                          Row<Dormant, ReaderOpened, Done, none, Not<Enabled>>,
                          Row<Waiting, AttemptDue, Waiting, Retry, Not<HeartbeatSeen>>,
                          Row<Waiting, AttemptDue, Done, none, HeartbeatSeen>>;

}  // namespace initial_acknack

struct InitialAckNack : FrontEnd<InitialAckNack> {
  using Io = InitialAckNackIo;
  using initial_state = initial_acknack::Dormant;
  using transition_table = initial_acknack::Transitions;
};

}  // namespace stormproof::fsm
