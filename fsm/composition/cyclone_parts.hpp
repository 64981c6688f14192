// What there is in Cyclone DDS besides what all implementations share: parts and who has one,
// timers, state, packets, the facts that rules ask for, and the steps that are stated by their
// contracts only. The rules are in fsm/composition/cyclone*.hpp.
// A writer of a participant is one of five builtin ones or that of a user topic; wherever other
// implementations say which stream, here it is said which of these. Samples are descriptors; those
// of user topics are not modelled, and the liveliness writer has one.
// A number that says until when something holds is 0 before the first time.
#pragma once

#include "fsm/cautious_reader.hpp"
#include "fsm/composition/announcements.hpp"
#include "fsm/composition/packets.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/event_thread.hpp"
#include "fsm/heartbeat_pacer.hpp"
#include "fsm/matched_reader.hpp"
#include "fsm/movable_timer.hpp"

namespace stormproof::fsm::composition::cyclone {

struct Judge : Part<CautiousReader, owner::relation> {};
struct Peer : Part<MatchedReader, owner::relation> {};
struct Pacer : Part<HeartbeatPacer, owner::writer> {};
struct Thread : Part<EventThread, owner::participant> {};
// The reader's, the writer's, and those of announcements.
struct AckTimer : Part<MovableTimer, owner::relation> {};
struct HeartbeatTimer : Part<MovableTimer, owner::writer> {};
struct SpdpTimer : Part<MovableTimer, owner::participant> {};
struct ReplyTimer : Part<MovableTimer, owner::pair> {};

struct AckTime : TimerAtDestination<owner::relation> {};
struct HeartbeatTime : Timer<owner::writer> {};
struct SpdpTime : Timer<owner::participant> {};
struct ReplyTime : Timer<owner::pair> {};
struct ThreadRun : Timer<owner::participant> {};

// When each timer is due, ns.
struct AckDue : Number<owner::relation> {};
struct HeartbeatDue : Number<owner::writer> {};
struct SpdpDue : Number<owner::participant> {};
struct ReplyDue : Number<owner::pair> {};

// The writer. `Exists` are the first H samples, `Sent` those up to the highest that went out.
struct Exists : Flag<owner::entry> {};
struct Sent : Flag<owner::entry> {};
struct HeartbeatCount : Number<owner::writer> {};
struct HeartbeatsSince : Number<owner::writer> {};  ///< n: since the interval began anew
struct LastHeartbeat : Number<owner::writer> {};    ///< t_hb, ns
struct HeartbeatSent : Flag<owner::writer> {};      ///< a periodic one
struct WriterOpen : Flag<owner::relation> {};       ///< the reader is matched
struct Acked : Number<owner::relation> {};
struct LastAckCount : Number<owner::relation> {};  ///< of the last ACKNACK that was accepted
struct AckCountsUntil : Number<owner::relation> {};
struct SomeAccepted : Flag<owner::relation> {};  ///< of the ACKNACK that is looked at
struct SomeRefused : Flag<owner::relation> {};

// The reader. `Known` are the samples up to the highest that it knows to exist.
struct Known : Flag<owner::descriptor> {};
struct Historic : Flag<owner::descriptor> {};  ///< the writer's first HEARTBEAT announced it
struct Notified : Flag<owner::descriptor> {};  ///< the application knows it
struct ByDelay : Flag<owner::relation> {};
struct AskedEnd : Number<owner::relation> {};
struct LastBase : Number<owner::relation> {};
struct LastHeartbeatCount : Number<owner::relation> {};
struct HeartbeatCountsUntil : Number<owner::relation> {};
struct QuietUntil : Number<owner::relation> {};
struct HushUntil : Number<owner::relation> {};
struct AgainAt : Number<owner::relation> {};
struct NextAckCount : Number<owner::relation> {};  ///< less 1

struct RepliesSent : Number<owner::pair> {};

struct HeartbeatInterval : DelayOf<"sedp.heartbeat_interval"> {};
struct HeartbeatIntervalMax : DelayOf<"sedp.heartbeat_interval_max"> {};
struct MatchHeartbeatDelay : DelayOf<"sedp.match_heartbeat_delay"> {};
struct AckDelay : DelayOf<"sedp.ack_delay">, OfDestination {};
struct NackDelay : DelayOf<"sedp.nack_delay">, OfDestination {};
struct AutoReschedNackDelay : DelayOf<"sedp.auto_resched_nack_delay">, OfDestination {};
struct PreEmptiveAckDelay : DelayOf<"sedp.preemptive_ack_delay">, OfDestination {};
struct PreEmptiveRepeatDelay : FixedDelay<1'000'000'000> {};
struct CountWindow : FixedDelay<500'000'000> {};  ///< how long counts are compared
struct SpdpStartupPeriod : DelayOf<"spdp.startup_period"> {};
struct SpdpPeriod : DelayOf<"spdp.period"> {};
struct DirectedReplies : DelayOf<"spdp.directed_replies"> {};  ///< how many
struct DirectedReplyInterval : DelayOf<"spdp.directed_reply_interval"> {};
struct SendTime : Delay {};  ///< of the deployment: between two packets of a participant
struct MergesQueued : SwitchOf<"sedp.merge_queued_rexmit", "true"> {};
struct TellsFreshAtOnce : SwitchOf<"sedp.notification", "fresh_at_once">, OfDestination {};

/// The count of a HEARTBEAT or ACKNACK.
struct Count : PacketNumber {};
/// An announcement or HEARTBEAT is meant for its receiver alone.
struct IsDirected : PacketField {};

struct Spdp : Packet<owner::pair, IsDirected> {};
struct Data : Packet<owner::relation, Carries> {};
struct Heartbeat : Packet<owner::relation, Announces, Count, IsDirected> {};
struct AckNack : Packet<owner::relation, Listed, BelowBase, Count, IsInitial> {};

struct Starts : Occasion<owner::participant> {};
struct Created : Occasion<owner::entry> {};
struct WriterOpens : Occasion<owner::relation> {};
struct PacketEnds : Occasion<owner::participant> {};  ///< all of it has been processed
// What the thread does when it takes a timer off its list, and how it ends.
struct AckTimerFires : Occasion<owner::relation> {};
struct HeartbeatTimerFires : Occasion<owner::writer> {};
struct SpdpTimerFires : Occasion<owner::participant> {};
struct ReplyTimerFires : Occasion<owner::pair> {};
struct ThreadPauses : Occasion<owner::participant> {};
struct ThreadSleeps : Occasion<owner::participant> {};

/// H.
struct History : Fact {
  template <class W>
  static auto of(W& w) {
    return w.count([](auto& d) { return d(Exists{}); });
  }
};
/// The number of the lowest sample that the reader lacks, from 1.
struct FirstMissing : Fact {
  template <class W>
  static auto of(W& w) {
    return w.count(is_confirmed) + 1;
  }
};
/// The reader has acknowledged everything, whether it has replied or not.
struct HasAll : Fact {
  template <class W>
  static auto of(W& w) {
    return !(w(History{}) > w(Acked{}));
  }
};
struct HasReplied : Fact {
  template <class W>
  static auto of(W& w) {
    return w.in(Peer{}, is<matched_reader::Replied>);
  }
};
/// Nothing is expected of the reader.
struct IsGood : Fact {
  template <class W>
  static auto of(W& w) {
    return w(HasReplied{}) && w(HasAll{}) && w(History{}) > 0;
  }
};
struct SomeWait : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto& r) { return !r(HasReplied{}) || !r(HasAll{}); });
  }
};
struct SomeHasAll : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto& r) { return r(HasAll{}); });
  }
};
struct OnlyOneIsNotGood : Fact {
  template <class W>
  static auto of(W& w) {
    return !(w.count_readers([](auto& r) { return !r(IsGood{}); }) > 1);
  }
};
struct HasReaders : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto&) { return typename W::Bool(true); });
  }
};

/// A retransmission of the sample is in the queue: to this reader alone; to whomever.
struct IsQueuedForIt : Answer {};
struct IsQueued : Answer {};
/// No more retransmissions are queued (`max_queued_rexmit_messages`).
struct QueueIsFull : Answer {};
/// A HEARTBEAT that answers this relation waits for the end of the received packet.
struct AnswerIsKept : Answer {};
struct SomeAnswerIsKept : Answer {};

template <class W>
void emit_heartbeat(W& w, bool directed) {
  w.emit(Heartbeat{},
         says(Says{Announces{}, [](auto& d) { return d(Exists{}); }},
              Says{Count{}, w(HeartbeatCount{})}, Says{IsDirected{}, typename W::Bool(directed)}));
}

/// One message to all readers that there are now: by name to a single participant each, or to the
/// multicast group. The thread packs it.
struct HeartbeatToAll : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_readers([](auto& r) { emit_heartbeat(r, false); });
  }
};
struct DataToAll : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_readers([](auto& r) {
      r.emit(Data{}, says(Says{Carries{}, [](auto& d) { return d.is_subject(); }}));
    });
  }
};
/// An announcement to the group and, without multicast, to each participant that is known.
struct Announce : Opaque {
  template <class W>
  static void contract(W& w) {
    w.emit(Spdp{}, says());
    w.for_known_peers([](auto& peer) { peer.emit(Spdp{}, says()); });
  }
};
/// The queued retransmission of the sample goes to all readers that there are now, if it goes to
/// another reader alone.
struct SendToAllInstead : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("it goes to another reader alone"), [&] { w.perform(DataToAll{}); });
  }
};
/// What is kept joins the queue.
struct LetAnswerGo : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// The timer joins the list of what its participant's thread has to do.
struct JoinList : Opaque {
  template <class W, class Timer>
  static void contract(W&, Timer) {}
};
/// The thread goes on: it fires the timers of its list, then takes what is queued, and packs what
/// both give into packets that it sends, copy by copy. What is in a packet that it begins to send
/// counts as sent.
struct Work : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("an ACK timer is on the list"), [&] { w.raise(AckTimerFires{}); });
    w.when(w.choice("a HEARTBEAT timer is on the list"), [&] { w.raise(HeartbeatTimerFires{}); });
    w.when(w.choice("its announcement timer is on the list"), [&] { w.raise(SpdpTimerFires{}); });
    w.when(w.choice("a reply timer is on the list"), [&] { w.raise(ReplyTimerFires{}); });
    w.set_each(Sent{}, [](auto& d) { return d(Sent{}) || d.choice("a packet with it goes out"); });
    w.when(w.choice("a copy has been sent, and that takes time"), [&] { w.raise(ThreadPauses{}); });
    w.when(w.choice("nothing is left"), [&] { w.raise(ThreadSleeps{}); });
  }
};
/// After a creation or a notification: each side of a user topic opens that now has what it needs,
/// which is that this side has created its endpoint and has been notified of the other's.
struct OpenTopics : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("a reader side can open"), [&] { w.raise(ReaderOpens{}); });
    w.when(w.choice("a writer side can open"), [&] { w.raise(WriterOpens{}); });
  }
};

}  // namespace stormproof::fsm::composition::cyclone
