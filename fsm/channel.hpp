// One channel of the route: it serves one fragment at a time, and it picks the next one only after
// every other event of the same instant (the *dispatch* event, last in the order of same-time
// events). Which fragment it picks is data (model/engine/waiting_fragments.hpp); that it never
// idles while something waits is here.
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct ChannelIo {
  template <class D>
  struct Input {
    typename D::Bool waiting{};           ///< at least one fragment waits for this channel
    typename D::Bool dispatch_pending{};  ///< a dispatch event of this channel is scheduled
  };
  template <class D>
  struct Output {
    typename D::Bool schedule_dispatch{};  ///< schedule a dispatch at this instant
    typename D::Bool serve{};  ///< take the first waiting fragment and occupy the channel
  };
};

namespace channel {

struct Idle : State {};
struct Busy : State {};

struct ServiceRequested : Event<ChannelIo> {};  ///< a fragment has joined the waiting ones
struct DispatchDue : Event<ChannelIo> {};
struct ServiceFinished : Event<ChannelIo> {};  ///< the fragment in service is done
struct EffectsDone : Event<ChannelIo> {
};  ///< all that followed from the end of service has been done

struct Waiting : Holds<Waiting> {
  static constexpr auto& flag(auto& in) { return in.waiting; }
};
struct DispatchPending : Holds<DispatchPending> {
  static constexpr auto& flag(auto& in) { return in.dispatch_pending; }
};

struct ScheduleDispatch : Sets<ScheduleDispatch> {
  static constexpr auto& flag(auto& out) { return out.schedule_dispatch; }
};
struct Serve : Sets<Serve> {
  static constexpr auto& flag(auto& out) { return out.serve; }
};

using Transitions =
    Table<Row<Idle, ServiceRequested, Idle, ScheduleDispatch, Not<DispatchPending>>,
          Row<Idle, DispatchDue, Busy, Serve, Waiting>, Row<Busy, ServiceFinished, Idle>,
          Row<Idle, EffectsDone, Idle, ScheduleDispatch, All<Waiting, Not<DispatchPending>>>>;

}  // namespace channel

struct Channel : FrontEnd<Channel> {
  using Io = ChannelIo;
  using initial_state = channel::Idle;
  using transition_table = channel::Transitions;
};

}  // namespace stormproof::fsm
