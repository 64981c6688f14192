// The reader side of a relation of Cyclone DDS, of builtin and of user writers alike: what it makes
// of DATA and HEARTBEATs, and what it asks for when its timer fires.
// Source: specs/guide/cyclone.md, "Match", "HEARTBEAT", "ACK timer" and "DATA".
#pragma once

#include "fsm/composition/cyclone_thread.hpp"

namespace stormproof::fsm::composition::cyclone {

/// What the machine wants done with its timer.
struct MoveAckTimer : Procedure {
  template <class W, class Outbox>
  static void body(W& w, const Outbox& reader) {
    w.when(reader.move, [&] { move<AckTimer, AckDue, AckTime>(w, reader.next_at); });
  }
};

/// `last` is the highest sample that is known to exist, `fresh` and `directed` are a HEARTBEAT's.
template <class Event, class W>
auto judge(W& w, const typename W::Int& last, const typename W::Bool& fresh,
           const typename W::Bool& directed) {
  return w.feed(Judge{}, on<Event>,
                {.fresh = fresh,
                 .directed = directed,
                 .by_delay = w(ByDelay{}),
                 .first_missing = w(FirstMissing{}),
                 .last = last,
                 .asked_end = w(AskedEnd{}),
                 .base = w(LastBase{}),
                 .now = w(Now{}),
                 .quiet_until = w(QuietUntil{}),
                 .hush_until = w(HushUntil{}),
                 .again_at = w(AgainAt{}),
                 .preemptive_delay = w(PreEmptiveAckDelay{}),
                 .repeat_delay = w(PreEmptiveRepeatDelay{}),
                 .again_delay = w(AutoReschedNackDelay{})});
}
template <class Event, class W>
auto judge(W& w) {
  const auto last = w.count([](auto& d) { return d(Known{}); });
  return judge<Event>(w, last, typename W::Bool(false), typename W::Bool(false));
}

struct ReaderIsOpened : Rule<Happens<ReaderOpens>> {
  template <class W>
  static void run(W& w) {
    const auto reader = judge<cautious_reader::Opened>(w);
    w.when(reader.opened, [&] { w.call(MoveAckTimer{}, reader); });
  }
};

/// All before it are there; or, of one that its writer's first HEARTBEAT did not know of yet, all
/// since then.
inline constexpr auto can_be_told = [](auto& d) {
  const auto in_order = d.all_up_to([](auto& e) { return e(X{}); });
  const auto fresh = d.all_up_to([](auto& e) { return e(X{}) || e(Historic{}); });
  return in_order || (d(TellsFreshAtOnce{}) && !d(Historic{}) && fresh);
};
/// Only the descriptors of endpoints are told to the application: `notify` is what happens then.
template <class W, class Notify>
void take_data(W& w, Notify&& notify) {
  const auto reader = judge<cautious_reader::DataReceived>(w);
  w.when(reader.take_data, [&] {
    w.set_each(Known{}, [](auto& d) {
      return d(Known{}) || d.some_from_here([](auto& e) { return e(Carries{}); });
    });
    w.set_each(X{}, [](auto& d) { return d(X{}) || d(Carries{}); });
    w.when(!w(RunEnds{}), [&] {
      w.for_descriptors([](auto& d) { return !d(Notified{}) && can_be_told(d); }, notify);
    });
  });
}
struct DataArrives : Rule<Received<Data>> {
  template <class W>
  static void run(W& w) {
    take_data(w, [](auto& d) {
      d.set(Notified{}, typename W::Bool(true));
      d.perform(OpenTopics{});
    });
  }
};

template <class W>
void take_heartbeat(W& w) {
  const auto last = w.count([](auto& d) { return d(Known{}) || d(Announces{}); });
  const auto fresh =
      w(Count{}) > w(LastHeartbeatCount{}) || !(w(HeartbeatCountsUntil{}) > w(Now{}));
  w.when(w.in(Judge{}, is<cautious_reader::Unheard>),
         [&] { w.set_each(Historic{}, [](auto& d) { return d(Announces{}); }); });
  const auto reader = judge<cautious_reader::HeartbeatReceived>(w, last, fresh, w(IsDirected{}));
  w.when(reader.learn,
         [&] { w.set_each(Known{}, [](auto& d) { return d(Known{}) || d(Announces{}); }); });
  w.when(reader.note, [&] {
    w.set(LastHeartbeatCount{}, w(Count{}));
    w.set(HeartbeatCountsUntil{}, w(Now{}) + w(CountWindow{}));
  });
  w.call(MoveAckTimer{}, reader);
}
struct HeartbeatArrives : Rule<Received<Heartbeat>> {
  template <class W>
  static void run(W& w) {
    take_heartbeat(w);
  }
};

/// What a request asks for.
inline constexpr auto is_lacking = [](auto& d) { return d(Known{}) && !d(X{}); };

/// An ACKNACK of its own that says what the reader has, and asks for what it lacks if it is a
/// request.
struct Reply : Procedure {
  template <class W, class Outbox>
  static void body(W& w, const Outbox& reader) {
    const auto base = w(FirstMissing{});
    w.set(LastBase{}, base);
    w.set(NextAckCount{}, w(NextAckCount{}) + 1);
    w.when(reader.request, [&] {
      w.emit(AckNack{}, says(Says{Listed{}, is_lacking}, Says{BelowBase{}, is_confirmed},
                             Says{Count{}, w(NextAckCount{})}));
      w.set(ByDelay{}, reader.delayed);
      w.set(AskedEnd{}, w.count([](auto& d) { return d(Known{}); }) + 1);
      w.set(HushUntil{}, w(Now{}) + w(NackDelay{}));
      w.set(AgainAt{}, w(Now{}) + w(AutoReschedNackDelay{}));
    });
    w.when(!reader.request, [&] {
      w.emit(AckNack{}, says(Says{BelowBase{}, is_confirmed}, Says{Count{}, w(NextAckCount{})}));
    });
  }
};

/// What the reader's timer makes it say, and what it wants done with the timer.
template <class W>
auto answer(W& w) {
  w.feed(AckTimer{}, on<movable_timer::Taken>);
  const auto reader = judge<cautious_reader::TimerFired>(w);
  w.when(reader.preempt, [&] {
    w.emit(AckNack{}, says(Says{IsInitial{}, typename W::Bool(true)}));
  });
  w.when(reader.reply, [&] { w.call(Reply{}, reader); });
  w.when(reader.preempt || reader.reply, [&] { w.set(QuietUntil{}, w(Now{}) + w(AckDelay{})); });
  return reader;
}
struct AckTimerIsTaken : Rule<Happens<AckTimerFires>> {
  template <class W>
  static void run(W& w) {
    w.call(MoveAckTimer{}, answer(w));
  }
};

using ReaderSideRules = TypeList<ReaderIsOpened, DataArrives, HeartbeatArrives, AckTimerIsTaken>;

}  // namespace stormproof::fsm::composition::cyclone
