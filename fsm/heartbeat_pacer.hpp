// When a writer of Cyclone DDS sends its next periodic HEARTBEAT: as long as somebody is behind, at
// an interval that doubles with every second HEARTBEAT beyond the sixth; a match, a new sample and
// a retransmission start the interval anew. To whom the HEARTBEAT goes is not in the machine.
// Source: specs/guide/cyclone.md, "HEARTBEAT timer".
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct HeartbeatPacerIo {
  template <class D>
  struct Input {
    typename D::Bool waiting{};      ///< some reader has not replied or not acknowledged everything
    typename D::Bool sent_before{};  ///< a periodic HEARTBEAT has been sent
    typename D::Int now{};           ///< ns
    typename D::Int last_sent{};     ///< when, ns
    typename D::Int number{};        ///< how many since the interval began anew
    typename D::Int interval{};      ///< of the first ones, ns
    typename D::Int interval_max{};  ///< which the interval stays below, ns
    typename D::Int match_delay{};   ///< ns
  };
  template <class D>
  struct Output {
    typename D::Bool send{};
    typename D::Bool restart{};  ///< the interval begins anew
    typename D::Bool move{};     ///< the timer, to `next_at`
    typename D::Int next_at{};   ///< ns
  };
};

namespace heartbeat_pacer {

struct Resting : State {};  ///< nobody waits, and the timer is not due
struct Pacing : State {};

struct Fired : Event<HeartbeatPacerIo> {};     ///< the timer
struct Matched : Event<HeartbeatPacerIo> {};   ///< a reader
struct Hastened : Event<HeartbeatPacerIo> {};  ///< a sample is new, or repeated

/// The interval after `number` HEARTBEATs: doubled for every second one beyond the fifth, but never
/// to `interval_max` or more.
template <class D>
constexpr typename D::Int interval_after(const HeartbeatPacerIo::Input<D>& in,
                                         const typename D::Int& number) {
  constexpr std::int64_t unhurried = 5;
  constexpr int most_doublings = 50;  // from 1 ns to 13 days
  typename D::Int interval = in.interval;
  for (int k = 1; k <= most_doublings; ++k) {
    const typename D::Int doubled = interval + interval;
    interval =
        D::select(!(number < typename D::Int(unhurried + 2 * k)) && doubled < in.interval_max,
                  doubled, interval);
  }
  return interval;
}

struct Waiting : Holds<Waiting> {
  static constexpr auto& flag(auto& in) { return in.waiting; }
};
struct TooEarly : Guard<TooEarly> {
  template <class D>
  static constexpr typename D::Bool test(const HeartbeatPacerIo::Input<D>& in) {
    return in.sent_before && in.now < in.last_sent + interval_after<D>(in, in.number);
  }
};

struct Greet : Action<Greet> {
  template <class D>
  static constexpr void act(const HeartbeatPacerIo::Input<D>& in,
                            HeartbeatPacerIo::Output<D>& out) {
    out.restart = true;
    out.move = true;
    out.next_at = in.now + in.match_delay;
  }
};
struct Hasten : Action<Hasten> {
  template <class D>
  static constexpr void act(const HeartbeatPacerIo::Input<D>& in,
                            HeartbeatPacerIo::Output<D>& out) {
    out.restart = true;
    out.move = true;
    out.next_at = in.now + in.interval;
  }
};
struct Postpone : Action<Postpone> {
  template <class D>
  static constexpr void act(const HeartbeatPacerIo::Input<D>& in,
                            HeartbeatPacerIo::Output<D>& out) {
    out.move = true;
    out.next_at = in.now + interval_after<D>(in, in.number);
  }
};
struct Send : Action<Send> {
  template <class D>
  static constexpr void act(const HeartbeatPacerIo::Input<D>& in,
                            HeartbeatPacerIo::Output<D>& out) {
    out.send = true;
    out.move = true;
    out.next_at = in.now + interval_after<D>(in, in.number + 1);
  }
};

using Transitions =
    Table<Row<Resting, Matched, Pacing, Greet>, Row<Pacing, Matched, Pacing, Greet>,
          Row<Resting, Hastened, Pacing, Hasten>, Row<Pacing, Hastened, Pacing, Hasten>,
          Row<Pacing, Fired, Resting, none, Not<Waiting>>,
          Row<Pacing, Fired, Pacing, Postpone, All<Waiting, TooEarly>>,
          Row<Pacing, Fired, Pacing, Send, All<Waiting, Not<TooEarly>>>>;

}  // namespace heartbeat_pacer

struct HeartbeatPacer : FrontEnd<HeartbeatPacer> {
  using Io = HeartbeatPacerIo;
  using initial_state = heartbeat_pacer::Resting;
  using transition_table = heartbeat_pacer::Transitions;
};

}  // namespace stormproof::fsm
