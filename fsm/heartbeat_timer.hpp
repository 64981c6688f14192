// The HEARTBEAT timer of one writer, for both policies.
// Periodic: idle → armed when a relation opens; each expiry sends and re-arms while some descriptor
// is not acknowledged; the end of a suppression arms it too (with the additive reading each arming
// adds an expiry). Adaptive (the paper's response-aware policy): a cycle awaits the readers'
// responses for one period; early if all respond, otherwise the period is stretched and the silent
// readers are paced over the rest of it. The adaptive arithmetic is in fsm/adaptive_period.hpp.
#pragma once

#include "fsm/adaptive_period.hpp"
#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct HeartbeatTimerIo {
  template <class D>
  struct Input {
    typename D::Int now{};               ///< ns
    typename D::Int heartbeat_period{};  ///< τ_H, ns
    typename D::Bool adaptive{};         ///< `heartbeat_policy: adaptive`
    typename D::Bool additive{};         ///< `heartbeat_timer: additive`
    typename D::Int pending{};  ///< expiries that are scheduled, the one processed now excluded
    typename D::Bool unacknowledged{};  ///< some open relation has a descriptor that is not in A
    AdaptiveCycle<D> cycle{};
  };
  template <class D>
  struct Output {
    typename D::Bool send{};             ///< a HEARTBEAT to the recipients of the policy
    typename D::Bool schedule_expiry{};  ///< periodic: next expiry at `next_at`
    typename D::Bool schedule_cycle{};   ///< adaptive: next cycle start at `next_at`
    typename D::Bool schedule_end{};     ///< adaptive: this cycle ends at `next_at`
    typename D::Bool pace{};        ///< adaptive: batches to the silent readers until `next_at`
    typename D::Bool send_batch{};  ///< adaptive: the HEARTBEATs of one batch
    typename D::Bool
        invalidate{};  ///< adaptive: every cycle and batch event scheduled before is void
    typename D::Bool count_response{};  ///< adaptive: this reader has responded in this cycle
    typename D::Int next_at{};          ///< ns
    typename D::Int period{};           ///< adaptive: the period T from now on, ns; 0 keeps it
  };
};

namespace heartbeat_timer {

struct Idle : State {};
struct Armed : State {};     ///< periodic: at least one expiry is pending
struct Pacing : State {};    ///< adaptive: active, waiting for the next cycle start
struct Awaiting : State {};  ///< adaptive: a cycle is running

struct ArmRequested : Event<HeartbeatTimerIo> {};
struct SuppressionEnded : Event<HeartbeatTimerIo> {};
struct Expired : Event<HeartbeatTimerIo> {};
struct CycleStarted : Event<HeartbeatTimerIo> {};
struct CycleEnded : Event<HeartbeatTimerIo> {};
struct BatchDue : Event<HeartbeatTimerIo> {};
struct ResponseReceived : Event<HeartbeatTimerIo> {};

struct Adaptive : Holds<Adaptive> {
  static constexpr auto& flag(auto& in) { return in.adaptive; }
};
struct Additive : Holds<Additive> {
  static constexpr auto& flag(auto& in) { return in.additive; }
};
struct Unacknowledged : Holds<Unacknowledged> {
  static constexpr auto& flag(auto& in) { return in.unacknowledged; }
};
struct LastPending : Guard<LastPending> {
  template <class D>
  static constexpr typename D::Bool test(const HeartbeatTimerIo::Input<D>& in) {
    return in.pending == 0;
  }
};
/// This response is the last one that the cycle waits for, and it comes before the period is over.
struct AllInTime : Guard<AllInTime> {
  template <class D>
  static constexpr typename D::Bool test(const HeartbeatTimerIo::Input<D>& in) {
    return in.cycle.responded + 1 == in.cycle.contacted &&
           in.now < in.cycle.start + in.cycle.period;
  }
};

struct Arm : Action<Arm> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    out.schedule_expiry = true;
    out.next_at = in.now + in.heartbeat_period;
  }
};
struct SendAndArm : Action<SendAndArm> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    out.send = true;
    Arm::act<D>(in, out);
  }
};
struct Activate : Action<Activate> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    out.schedule_cycle = true;
    out.period = in.heartbeat_period;
    out.next_at = in.now + in.heartbeat_period;
  }
};
struct Deactivate : Action<Deactivate> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    out.invalidate = true;
    out.period = in.heartbeat_period;
  }
};
struct StartCycle : Action<StartCycle> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    out.invalidate = true;
    out.send = true;
    out.schedule_end = true;
    out.next_at = in.now + in.cycle.period;
  }
};
struct EndCycle : Action<EndCycle> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    const typename D::Int stretched = stretched_period<D>(in.cycle);
    const typename D::Int rest = stretched - in.cycle.period;
    out.invalidate = true;
    out.pace = true;
    out.schedule_cycle = true;
    out.period = stretched;
    out.next_at = in.now + max<D>(rest, 1);
  }
};
struct SendBatch : Sets<SendBatch> {
  static constexpr auto& flag(auto& out) { return out.send_batch; }
};
struct CountResponse : Sets<CountResponse> {
  static constexpr auto& flag(auto& out) { return out.count_response; }
};
struct EndEarly : Action<EndEarly> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    out.count_response = true;
    out.invalidate = true;
    out.schedule_cycle = true;
    out.period = clamped_period<D>(in.cycle, in.now - in.cycle.start);
    out.next_at = max<D>(in.now, in.cycle.start + out.period);
  }
};
struct EndAll : Action<EndAll> {
  template <class D>
  static constexpr void act(const HeartbeatTimerIo::Input<D>& in,
                            HeartbeatTimerIo::Output<D>& out) {
    out.count_response = true;
    Deactivate::act<D>(in, out);
  }
};

using Transitions = Table<
    // Periodic policy.
    Row<Idle, ArmRequested, Armed, Arm, Not<Adaptive>>,
    Row<Idle, SuppressionEnded, Armed, Arm, Not<Adaptive>>,
    Row<Armed, SuppressionEnded, Armed, Arm, Additive>,
    Row<Armed, Expired, Armed, SendAndArm, Unacknowledged>,
    Row<Armed, Expired, Armed, none, All<Not<Unacknowledged>, Not<LastPending>>>,
    Row<Armed, Expired, Idle, none, All<Not<Unacknowledged>, LastPending>>,
    // Adaptive policy.
    Row<Idle, ArmRequested, Pacing, Activate, Adaptive>,
    Row<Pacing, CycleStarted, Awaiting, StartCycle, Unacknowledged>,
    Row<Pacing, CycleStarted, Idle, Deactivate, Not<Unacknowledged>>,
    Row<Awaiting, CycleEnded, Pacing, EndCycle>, Row<Pacing, BatchDue, Pacing, SendBatch>,
    Row<Awaiting, ResponseReceived, Awaiting, CountResponse, Not<AllInTime>>,
    Row<Awaiting, ResponseReceived, Pacing, EndEarly, All<AllInTime, Unacknowledged>>,
    Row<Awaiting, ResponseReceived, Idle, EndAll, All<AllInTime, Not<Unacknowledged>>>,
    Row<Pacing, ResponseReceived, Pacing, CountResponse, Not<AllInTime>>,
    Row<Pacing, ResponseReceived, Pacing, EndEarly, All<AllInTime, Unacknowledged>>,
    Row<Pacing, ResponseReceived, Idle, EndAll, All<AllInTime, Not<Unacknowledged>>>>;

}  // namespace heartbeat_timer

struct HeartbeatTimer : FrontEnd<HeartbeatTimer> {
  using Io = HeartbeatTimerIo;
  using initial_state = heartbeat_timer::Idle;
  using transition_table = heartbeat_timer::Transitions;
};

}  // namespace stormproof::fsm
