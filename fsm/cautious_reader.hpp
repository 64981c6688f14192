// The reader side of a relation in Cyclone DDS. There it is the reader who limits what is asked
// for: it judges each HEARTBEAT, asks at once for what it has not asked for yet, waits before it
// asks for the same again unless a HEARTBEAT is meant for it alone, and says nothing that it has
// just said. When it answers is a timer of its own.
// Source: specs/guide/cyclone.md, "HEARTBEAT" and "ACK timer".
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct CautiousReaderIo {
  /// Samples count from 1; a time until which something holds is 0 if it never did.
  template <class D>
  struct Input {
    typename D::Bool fresh{};         ///< the HEARTBEAT's count is new, or the last one is long ago
    typename D::Bool directed{};      ///< it is meant for this reader alone
    typename D::Bool by_delay{};      ///< the last request repeated another one, after NackDelay
    typename D::Int first_missing{};  ///< b
    typename D::Int last{};           ///< highest sample known to exist, by this HEARTBEAT, too
    typename D::Int asked_end{};      ///< what is below it has been asked for
    typename D::Int base{};           ///< of the last ACKNACK
    typename D::Int now{};            ///< ns
    typename D::Int quiet_until{};    ///< AckDelay after the last ACKNACK, ns
    typename D::Int hush_until{};     ///< NackDelay after the last request, ns
    typename D::Int again_at{};       ///< AutoReschedNackDelay after it, ns
    typename D::Int preemptive_delay{};
    typename D::Int repeat_delay{};  ///< between pre-emptive ACKNACKs, ns
    typename D::Int again_delay{};   ///< AutoReschedNackDelay, ns
  };
  template <class D>
  struct Output {
    typename D::Bool opened{};
    typename D::Bool take_data{};
    typename D::Bool learn{};    ///< what the HEARTBEAT announces exists
    typename D::Bool note{};     ///< its count is the last one accepted
    typename D::Bool preempt{};  ///< send the pre-emptive ACKNACK
    typename D::Bool reply{};    ///< send an ACKNACK
    typename D::Bool request{};  ///< one that asks for what is missing
    typename D::Bool delayed{};  ///< and repeats another one
    typename D::Bool move{};     ///< the timer, to `next_at`
    typename D::Int next_at{};   ///< ns
  };
};

namespace cautious_reader {

struct Closed : State {};
struct Unheard : State {};    ///< open, no HEARTBEAT seen
struct Answered : State {};   ///< nothing heard since the last ACKNACK
struct Heard : State {};      ///< a HEARTBEAT has been accepted since
struct Addressed : State {};  ///< and one of them was meant for this reader alone

struct Opened : Event<CautiousReaderIo> {};
struct DataReceived : Event<CautiousReaderIo> {};
struct HeartbeatReceived : Event<CautiousReaderIo> {};
struct TimerFired : Event<CautiousReaderIo> {};

/// What the reader has to say, if anything.
template <class D>
struct Verdict {
  typename D::Bool nack;     ///< it asks
  typename D::Bool delayed;  ///< because it is long since it asked for the same
  typename D::Bool hush;     ///< it lacks something, but has asked for it
  typename D::Bool ack;      ///< it lacks nothing
};

/// `heard`: a HEARTBEAT has been accepted since the last ACKNACK; `addressed`: one for this reader.
template <class D>
constexpr Verdict<D> judge(const CautiousReaderIo::Input<D>& in, const typename D::Bool& heard,
                           const typename D::Bool& addressed) {
  const typename D::Bool complete = in.last < in.first_missing;
  const typename D::Bool over = !(in.now < in.hush_until);
  const typename D::Bool unasked = !complete && !(in.first_missing < in.asked_end);
  const typename D::Bool urged = !complete && addressed && (!in.by_delay || over);
  const typename D::Bool late = !complete && !unasked && !urged && over;
  const typename D::Bool nack = unasked || urged || late;
  const typename D::Bool news = heard && (in.base < in.first_missing || !(in.now < in.quiet_until));
  return {nack, late, !complete && !nack && news, complete && news};
}

template <bool heard, bool addressed>
struct Nack : Guard<Nack<heard, addressed>> {
  template <class D>
  static constexpr typename D::Bool test(const CautiousReaderIo::Input<D>& in) {
    return judge<D>(in, heard, addressed).nack;
  }
};
template <bool addressed>
struct Hush : Guard<Hush<addressed>> {
  template <class D>
  static constexpr typename D::Bool test(const CautiousReaderIo::Input<D>& in) {
    return judge<D>(in, true, addressed).hush;
  }
};
template <bool addressed>
struct Ack : Guard<Ack<addressed>> {
  template <class D>
  static constexpr typename D::Bool test(const CautiousReaderIo::Input<D>& in) {
    return judge<D>(in, true, addressed).ack;
  }
};
struct Fresh : Holds<Fresh> {
  static constexpr auto& flag(auto& in) { return in.fresh; }
};
struct Directed : Holds<Directed> {
  static constexpr auto& flag(auto& in) { return in.directed; }
};
struct TooEarly : Guard<TooEarly> {
  template <class D>
  static constexpr typename D::Bool test(const CautiousReaderIo::Input<D>& in) {
    return in.now < in.again_at;
  }
};

struct Open : Action<Open> {
  template <class D>
  static constexpr void act(const CautiousReaderIo::Input<D>& in,
                            CautiousReaderIo::Output<D>& out) {
    out.opened = true;
    out.move = true;
    out.next_at = in.now + in.preemptive_delay;
  }
};
struct TakeData : Sets<TakeData> {
  static constexpr auto& flag(auto& out) { return out.take_data; }
};
struct Learn : Sets<Learn> {
  static constexpr auto& flag(auto& out) { return out.learn; }
};
/// It answers now, or when it may ask for the same again.
template <bool addressed>
struct Hear : Action<Hear<addressed>> {
  template <class D>
  static constexpr void act(const CautiousReaderIo::Input<D>& in,
                            CautiousReaderIo::Output<D>& out) {
    const Verdict<D> verdict = judge<D>(in, true, addressed);
    out.learn = true;
    out.note = true;
    out.move = verdict.nack || verdict.hush || verdict.ack;
    out.next_at = D::select(verdict.hush, in.hush_until, in.now);
  }
};
struct Preempt : Action<Preempt> {
  template <class D>
  static constexpr void act(const CautiousReaderIo::Input<D>& in,
                            CautiousReaderIo::Output<D>& out) {
    out.preempt = true;
    out.move = true;
    out.next_at = in.now + in.repeat_delay;
  }
};
template <bool heard, bool addressed>
struct Ask : Action<Ask<heard, addressed>> {
  template <class D>
  static constexpr void act(const CautiousReaderIo::Input<D>& in,
                            CautiousReaderIo::Output<D>& out) {
    out.reply = true;
    out.request = true;
    out.delayed = judge<D>(in, heard, addressed).delayed;
    out.move = true;
    out.next_at = in.now + in.again_delay;
  }
};
struct Wait : Action<Wait> {
  template <class D>
  static constexpr void act(const CautiousReaderIo::Input<D>& in,
                            CautiousReaderIo::Output<D>& out) {
    out.move = true;
    out.next_at = in.again_at;
  }
};
struct KeepQuiet : Action<KeepQuiet> {
  template <class D>
  static constexpr void act(const CautiousReaderIo::Input<D>& in,
                            CautiousReaderIo::Output<D>& out) {
    out.reply = true;
    out.move = true;
    out.next_at = in.hush_until;
  }
};
struct Acknowledge : Sets<Acknowledge> {
  static constexpr auto& flag(auto& out) { return out.reply; }
};

using Ordinary = Not<Directed>;
using Stale = Not<Fresh>;

using Transitions = Table<
    Row<Closed, Opened, Unheard, Open>,
    // DATA.
    Row<Answered, DataReceived, Answered, TakeData>, Row<Heard, DataReceived, Heard, TakeData>,
    Row<Addressed, DataReceived, Addressed, TakeData>,
    // HEARTBEATs.
    Row<Unheard, HeartbeatReceived, Answered, Learn, Stale>,
    Row<Unheard, HeartbeatReceived, Heard, Hear<false>, All<Fresh, Ordinary>>,
    Row<Unheard, HeartbeatReceived, Addressed, Hear<true>, All<Fresh, Directed>>,
    Row<Answered, HeartbeatReceived, Answered, Learn, Stale>,
    Row<Answered, HeartbeatReceived, Heard, Hear<false>, All<Fresh, Ordinary>>,
    Row<Answered, HeartbeatReceived, Addressed, Hear<true>, All<Fresh, Directed>>,
    Row<Heard, HeartbeatReceived, Heard, Learn, Stale>,
    Row<Heard, HeartbeatReceived, Heard, Hear<false>, All<Fresh, Ordinary>>,
    Row<Heard, HeartbeatReceived, Addressed, Hear<true>, All<Fresh, Directed>>,
    Row<Addressed, HeartbeatReceived, Addressed, Learn, Stale>,
    Row<Addressed, HeartbeatReceived, Addressed, Hear<true>, Fresh>,
    // The timer.
    Row<Unheard, TimerFired, Unheard, Preempt>,
    Row<Answered, TimerFired, Answered, Wait, All<Nack<false, false>, TooEarly>>,
    Row<Answered, TimerFired, Answered, Ask<false, false>, All<Nack<false, false>, Not<TooEarly>>>,
    Row<Heard, TimerFired, Answered, Ask<true, false>, Nack<true, false>>,
    Row<Heard, TimerFired, Answered, KeepQuiet, Hush<false>>,
    Row<Heard, TimerFired, Answered, Acknowledge, Ack<false>>,
    Row<Addressed, TimerFired, Answered, Ask<true, true>, Nack<true, true>>,
    Row<Addressed, TimerFired, Answered, KeepQuiet, Hush<true>>,
    Row<Addressed, TimerFired, Answered, Acknowledge, Ack<true>>>;

}  // namespace cautious_reader

struct CautiousReader : FrontEnd<CautiousReader> {
  using Io = CautiousReaderIo;
  using initial_state = cautious_reader::Closed;
  using transition_table = cautious_reader::Transitions;
};

}  // namespace stormproof::fsm
