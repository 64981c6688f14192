// The event thread of Cyclone DDS, what wakes it, and the timers that it fires: each timer has its
// rule that puts it on the list when its time has come. Announcements, which only have a timer, are
// here, too.
// Source: specs/guide/cyclone.md, "State", "The event thread" and "SPDP".
#pragma once

#include "fsm/composition/cyclone_parts.hpp"
#include "fsm/composition/single_shots.hpp"

namespace stormproof::fsm::composition::cyclone {

/// The thread has something to do.
struct Wake : Procedure {
  template <class W>
  static void body(W& w) {
    const auto thread = w.feed(Thread{}, on<event_thread::Woken>, {.now = w(Now{})});
    w.when(thread.schedule, [&] { w.at(thread.next_at, ThreadRun{}); });
  }
};
/// A run of the thread does what `Step` says.
template <class Step>
struct RunOfThread : Rule<Due<ThreadRun>> {
  template <class W>
  static void run(W& w) {
    const auto thread = w.feed(Thread{}, on<event_thread::RunDue>);
    w.when(thread.work, [&] { w.perform(Step{}); });
  }
};
struct ThreadRuns : RunOfThread<Work> {};
struct CopyIsSent : Rule<Happens<ThreadPauses>> {
  template <class W>
  static void run(W& w) {
    const auto thread =
        w.feed(Thread{}, on<event_thread::CopySent>, {.now = w(Now{}), .send_time = w(SendTime{})});
    w.when(thread.schedule, [&] { w.at(thread.next_at, ThreadRun{}); });
  }
};
struct NothingIsLeft : Rule<Happens<ThreadSleeps>> {
  template <class W>
  static void run(W& w) {
    w.feed(Thread{}, on<event_thread::NothingLeft>);
  }
};

/// Moves a timer to `to`, unless it is due earlier.
template <class Part, class DueTime, class Time, class W>
void move(W& w, const typename W::Int& to) {
  const auto timer =
      w.feed(Part{}, on<movable_timer::Moved>, {.now = w(Now{}), .due = w(DueTime{}), .to = to});
  w.when(timer.schedule, [&] {
    w.set(DueTime{}, to);
    w.at(to, Time{});
  });
}
/// A time has come that a timer was moved to.
template <class Part, class DueTime, class W, class Body>
void come(W& w, Body&& wake) {
  const auto timer =
      w.feed(Part{}, on<movable_timer::Came>, {.now = w(Now{}), .due = w(DueTime{})});
  w.when(timer.join, [&] {
    w.perform(JoinList{}, Part{});
    wake();
  });
}

struct HeartbeatTimeHasCome : Rule<Due<HeartbeatTime>> {
  template <class W>
  static void run(W& w) {
    come<HeartbeatTimer, HeartbeatDue>(w, [&] { w.call(Wake{}); });
  }
};
/// The reader's timer is one of the reader's participant.
struct AckTimeHasCome : Rule<Due<AckTime>> {
  template <class W>
  static void run(W& w) {
    come<AckTimer, AckDue>(w, [&] { w.reverse([](auto& back) { back.call(Wake{}); }); });
  }
};
struct SpdpTimeHasCome : Rule<Due<SpdpTime>> {
  template <class W>
  static void run(W& w) {
    come<SpdpTimer, SpdpDue>(w, [&] { w.call(Wake{}); });
  }
};
struct ReplyTimeHasCome : Rule<Due<ReplyTime>> {
  template <class W>
  static void run(W& w) {
    come<ReplyTimer, ReplyDue>(w, [&] { w.call(Wake{}); });
  }
};

/// Announcements: one at the start, one after the startup period, and then one a period.
struct AnnounceAndGoOn : Procedure {
  template <class W, class Wait>
  static void body(W& w, Wait) {
    w.perform(Announce{});
    w.call(Wake{});
    move<SpdpTimer, SpdpDue, SpdpTime>(w, w(Now{}) + w(Wait{}));
  }
};
struct ParticipantStarts : Rule<Happens<Starts>> {
  template <class W>
  static void run(W& w) {
    w.call(AnnounceAndGoOn{}, SpdpStartupPeriod{});
  }
};
struct SpdpTimerIsTaken : Rule<Happens<SpdpTimerFires>> {
  template <class W>
  static void run(W& w) {
    w.feed(SpdpTimer{}, on<movable_timer::Taken>);
    w.call(AnnounceAndGoOn{}, SpdpPeriod{});
  }
};

/// Replies to the one who has announced itself; `w` is the pair of the one who replies and it.
struct MoveReplyTimer : Procedure {
  template <class W, class Wait>
  static void body(W& w, Wait) {
    move<ReplyTimer, ReplyDue, ReplyTime>(w, w(Now{}) + w(Wait{}));
  }
};
/// `Most` is how many there are.
template <class Most>
struct NextReply : Rule<Happens<ReplyTimerFires>> {
  template <class W>
  static void run(W& w) {
    w.feed(ReplyTimer{}, on<movable_timer::Taken>);
    w.emit(Spdp{}, says(Says{IsDirected{}, typename W::Bool(true)}));
    w.call(Wake{});
    w.set(RepliesSent{}, w(RepliesSent{}) + 1);
    w.when(w(Most{}) > w(RepliesSent{}),
           [&] { w.call(MoveReplyTimer{}, DirectedReplyInterval{}); });
  }
};
struct ReplyTimerIsTaken : NextReply<DirectedReplies> {};
/// Both sides of all builtin relations open, and the one who has announced itself is answered.
template <class W>
void recognise(W& w) {
  w.set(Recognised{}, typename W::Bool(true));
  w.for_streams([](auto& r) {
    r.reverse([](auto& back) { back.raise(WriterOpens{}); });
    r.raise(ReaderOpens{});
  });
  w.when(!w(IsDirected{}), [&] {
    w.reverse([](auto& back) {
      back.when(back(DirectedReplies{}) > 0, [&] { back.call(MoveReplyTimer{}, Immediately{}); });
    });
  });
}
/// What a participant does when it hears of another one for the first time. `w` is the pair of the
/// one who announced itself and the one who hears it.
struct AnnouncementArrives : Rule<Received<Spdp>> {
  template <class W>
  static void run(W& w) {
    w.when(!w(Recognised{}), [&] { recognise(w); });
  }
};

using ThreadRules = TypeList<ThreadRuns, CopyIsSent, NothingIsLeft, HeartbeatTimeHasCome,
                             AckTimeHasCome, SpdpTimeHasCome, ReplyTimeHasCome>;
using AnnouncingRules =
    TypeList<ParticipantStarts, SpdpTimerIsTaken, ReplyTimerIsTaken, AnnouncementArrives>;

}  // namespace stormproof::fsm::composition::cyclone
