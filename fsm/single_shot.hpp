// A timer that is pending at most once: asking for it again while it is pending changes nothing,
// and it keeps its time. All of Fast DDS's delays are of this kind (its restart of a running timer
// is a no-op): the nack response of a writer, the suppression of a relation, the reply to
// HEARTBEATs, the run of the async queue.
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct SingleShotIo {
  template <class D>
  struct Input {
    typename D::Int now{};    ///< ns
    typename D::Int delay{};  ///< ns
  };
  template <class D>
  struct Output {
    typename D::Bool schedule{};  ///< due at `next_at`
    typename D::Bool fire{};      ///< what was asked for happens now
    typename D::Int next_at{};    ///< ns
  };
};

namespace single_shot {

struct Idle : State {};
struct Pending : State {};

struct Requested : Event<SingleShotIo> {};
struct Due : Event<SingleShotIo> {};

struct Schedule : Action<Schedule> {
  template <class D>
  static constexpr void act(const SingleShotIo::Input<D>& in, SingleShotIo::Output<D>& out) {
    out.schedule = true;
    out.next_at = in.now + in.delay;
  }
};
struct Fire : Sets<Fire> {
  static constexpr auto& flag(auto& out) { return out.fire; }
};

using Transitions = Table<Row<Idle, Requested, Pending, Schedule>, Row<Pending, Due, Idle, Fire>>;

}  // namespace single_shot

struct SingleShot : FrontEnd<SingleShot> {
  using Io = SingleShotIo;
  using initial_state = single_shot::Idle;
  using transition_table = single_shot::Transitions;
};

}  // namespace stormproof::fsm
