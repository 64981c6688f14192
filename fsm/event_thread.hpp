// The one thread of a Cyclone DDS participant that fires timers and sends: it sleeps until it is
// woken, works until nothing is left, and pauses while a packet goes out. What it does when it
// works is not in the machine.
// Source: specs/guide/cyclone.md, "The event thread".
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct EventThreadIo {
  template <class D>
  struct Input {
    typename D::Int now{};        ///< ns
    typename D::Int send_time{};  ///< that a packet takes, ns
  };
  template <class D>
  struct Output {
    typename D::Bool schedule{};  ///< a run at `next_at`
    typename D::Bool work{};      ///< it goes on where it was
    typename D::Int next_at{};    ///< ns
  };
};

namespace event_thread {

struct Asleep : State {};
struct Expected : State {};  ///< a run is scheduled
struct Working : State {};

struct Woken : Event<EventThreadIo> {};
struct RunDue : Event<EventThreadIo> {};
struct CopySent : Event<EventThreadIo> {};  ///< and that takes time
struct NothingLeft : Event<EventThreadIo> {};

struct RunNow : Action<RunNow> {
  template <class D>
  static constexpr void act(const EventThreadIo::Input<D>& in, EventThreadIo::Output<D>& out) {
    out.schedule = true;
    out.next_at = in.now;
  }
};
struct Pause : Action<Pause> {
  template <class D>
  static constexpr void act(const EventThreadIo::Input<D>& in, EventThreadIo::Output<D>& out) {
    out.schedule = true;
    out.next_at = in.now + in.send_time;
  }
};
struct Work : Sets<Work> {
  static constexpr auto& flag(auto& out) { return out.work; }
};

using Transitions =
    Table<Row<Asleep, Woken, Expected, RunNow>, Row<Expected, RunDue, Working, Work>,
          Row<Working, CopySent, Expected, Pause>, Row<Working, NothingLeft, Asleep>>;

}  // namespace event_thread

struct EventThread : FrontEnd<EventThread> {
  using Io = EventThreadIo;
  using initial_state = event_thread::Asleep;
  using transition_table = event_thread::Transitions;
};

}  // namespace stormproof::fsm
