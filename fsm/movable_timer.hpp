// A timer of Cyclone DDS's event thread: it can only be moved to an earlier time, and when its time
// has come it joins the list of what the thread has to do. Whatever was scheduled for it before
// stays scheduled and finds nothing. HEARTBEATs, ACKNACKs and announcements wait for such timers.
// Source: specs/guide/cyclone.md, "State".
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct MovableTimerIo {
  template <class D>
  struct Input {
    typename D::Int now{};  ///< ns
    typename D::Int due{};  ///< when it is due, if it is scheduled, ns
    typename D::Int to{};   ///< where it is to be moved, ns
  };
  template <class D>
  struct Output {
    typename D::Bool schedule{};  ///< it comes where it is moved, which is its due time from now on
    typename D::Bool join{};      ///< it joins the thread's list
  };
};

namespace movable_timer {

struct Idle : State {};       ///< never due
struct Scheduled : State {};  ///< due some time
struct Listed : State {};     ///< due, and in the thread's list

struct Moved : Event<MovableTimerIo> {};
struct Came : Event<MovableTimerIo> {};   ///< a time has come that it was moved to
struct Taken : Event<MovableTimerIo> {};  ///< the thread fires it

struct Earlier : Guard<Earlier> {
  template <class D>
  static constexpr typename D::Bool test(const MovableTimerIo::Input<D>& in) {
    return in.to < in.due;
  }
};
struct IsDue : Guard<IsDue> {
  template <class D>
  static constexpr typename D::Bool test(const MovableTimerIo::Input<D>& in) {
    return in.due == in.now;
  }
};

struct Schedule : Sets<Schedule> {
  static constexpr auto& flag(auto& out) { return out.schedule; }
};
struct Join : Sets<Join> {
  static constexpr auto& flag(auto& out) { return out.join; }
};

using Transitions = Table<Row<Idle, Moved, Scheduled, Schedule>,
                          Row<Scheduled, Moved, Scheduled, Schedule, Earlier>,
                          Row<Scheduled, Came, Listed, Join, IsDue>, Row<Listed, Taken, Idle>>;

}  // namespace movable_timer

struct MovableTimer : FrontEnd<MovableTimer> {
  using Io = MovableTimerIo;
  using initial_state = movable_timer::Idle;
  using transition_table = movable_timer::Transitions;
};

}  // namespace stormproof::fsm
