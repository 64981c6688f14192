// Cyclone DDS 0.10 (specs/guide/cyclone.md, executed by model/cyclone): nothing is pushed to a late
// joiner, a HEARTBEAT goes to everybody while anybody is behind, the reader limits what it asks for
// (fsm/composition/cyclone_reader.hpp), and one thread of each participant packs what is sent
// (cyclone_thread.hpp). Here is the writer, and `Cyclone`, the whole composition.
#pragma once

#include <array>

#include "fsm/composition/cyclone_reader.hpp"

namespace stormproof::fsm::composition::cyclone {

/// The HEARTBEAT clock of a writer hears of an event.
struct PacerGoesOn : Procedure {
  template <class W, class Outbox>
  static void body(W& w, const Outbox& pacer) {
    w.when(pacer.restart, [&] { w.set(HeartbeatsSince{}, 0); });
    w.when(pacer.move,
           [&] { move<HeartbeatTimer, HeartbeatDue, HeartbeatTime>(w, pacer.next_at); });
  }
};
template <class Event, class W>
auto pace(W& w) {
  return w.feed(Pacer{}, on<Event>,
                {.waiting = w(SomeWait{}),
                 .sent_before = w(HeartbeatSent{}),
                 .now = w(Now{}),
                 .last_sent = w(LastHeartbeat{}),
                 .number = w(HeartbeatsSince{}),
                 .interval = w(HeartbeatInterval{}),
                 .interval_max = w(HeartbeatIntervalMax{}),
                 .match_delay = w(MatchHeartbeatDelay{})});
}

/// A new reader counts as having everything that exists, until it says otherwise.
struct ReaderIsMatched : Rule<Happens<WriterOpens>> {
  template <class W>
  static void run(W& w) {
    const auto peer = w.feed(Peer{}, on<matched_reader::Opened>);
    w.when(peer.matched, [&] {
      w.set(WriterOpen{}, typename W::Bool(true));
      w.set(Acked{}, w(History{}));
      w.call(PacerGoesOn{}, pace<heartbeat_pacer::Matched>(w));
    });
  }
};

/// To the only one who is behind, if somebody has everything; otherwise to all.
struct HeartbeatTimerIsTaken : Rule<Happens<HeartbeatTimerFires>> {
  template <class W>
  static void run(W& w) {
    w.feed(HeartbeatTimer{}, on<movable_timer::Taken>);
    const auto pacer = pace<heartbeat_pacer::Fired>(w);
    w.when(pacer.send, [&] {
      w.set(HeartbeatCount{}, w(HeartbeatCount{}) + 1);
      const auto to_one = w(SomeHasAll{}) && w(OnlyOneIsNotGood{});
      w.when(to_one, [&] {
        w.for_readers([](auto& r) { r.when(!r(IsGood{}), [&] { emit_heartbeat(r, false); }); });
      });
      w.when(!to_one, [&] { w.perform(HeartbeatToAll{}); });
      w.set(LastHeartbeat{}, w(Now{}));
      w.set(HeartbeatSent{}, typename W::Bool(true));
      w.set(HeartbeatsSince{}, w(HeartbeatsSince{}) + 1);
    });
    w.call(PacerGoesOn{}, pacer);
  }
};

/// What is created is pushed to those that are matched.
struct DescriptorIsCreated : Rule<Happens<Created>> {
  template <class W>
  static void run(W& w) {
    w.perform(OpenTopics{});
    w.set(Exists{}, typename W::Bool(true));
    const auto has_readers = w(HasReaders{});
    w.when(!has_readers, [&] { w.set(Sent{}, typename W::Bool(true)); });
    w.when(has_readers, [&] {
      w.call(PacerGoesOn{}, pace<heartbeat_pacer::Hastened>(w));
      w.perform(DataToAll{});
      w.call(Wake{});
    });
  }
};

/// What is kept for the end of the packet is sent.
struct AnswerGoes : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(w(SomeAnswerIsKept{}), [&] {
      w.perform(LetAnswerGo{});
      w.call(Wake{});
    });
  }
};
/// A HEARTBEAT to the reader of a relation, which it has to answer. It waits for the end of the
/// packet that is being processed, or until another relation is answered.
struct AnswerReader : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(!w(AnswerIsKept{}), [&] {
      w.call(AnswerGoes{});
      w.set(HeartbeatCount{}, w(HeartbeatCount{}) + 1);
      emit_heartbeat(w, true);
    });
  }
};

/// A sample is repeated: a retransmission that is queued for another reader goes to all instead.
template <class D>
void repeat(D& d) {
  const auto found = d(IsQueuedForIt{}) || (d(MergesQueued{}) && d(IsQueued{}));
  const auto refused = !found && d(QueueIsFull{});
  d.when(found && d(MergesQueued{}), [&] { d.perform(SendToAllInstead{}); });
  d.when(!found && !refused, [&] {
    d.emit(Data{}, says(Says{Carries{}, [](auto& e) { return e.is_subject(); }}));
    d.call(Wake{});
  });
  d.when(refused, [&] { d.set(SomeRefused{}, typename D::Bool(true)); });
  d.when(!refused, [&] { d.set(SomeAccepted{}, typename D::Bool(true)); });
}
/// Sample by sample, until one is refused: what is done about each, and then about all.
template <class W, class Each, class Then>
void repeat_listed(W& w, Each&& each, Then&& then) {
  w.set(SomeAccepted{}, typename W::Bool(false));
  w.set(SomeRefused{}, typename W::Bool(false));
  w.for_descriptors([](auto& d) { return d(Listed{}) && d(Sent{}) && !d(SomeRefused{}); }, each);
  then();
  w.when(w(SomeAccepted{}), [&] {
    w.call(AnswerReader{});
    w.call(PacerGoesOn{}, pace<heartbeat_pacer::Hastened>(w));
  });
}
struct RepeatListed : Procedure {
  template <class W>
  static void body(W& w) {
    repeat_listed(
        w, [](auto& d) { repeat(d); }, [] {});
  }
};

/// `repeat` is what is done about what the ACKNACK asks for.
template <class W, class Repeat>
void take_acknack(W& w, Repeat repeat) {
  const auto preemptive = w(IsInitial{});
  const auto fresh = w(Count{}) > w(LastAckCount{}) || !(w(AckCountsUntil{}) > w(Now{}));
  const auto below_base = w.count([](auto& d) { return d(BelowBase{}) && d(Exists{}); });
  const auto asks = w.some([](auto& d) { return d(Listed{}); });
  const auto peer =
      w.feed(Peer{}, on<matched_reader::AckNackReceived>,
             {.accepted = fresh || preemptive, .replies = !asks && !(w(Acked{}) > below_base)});
  w.when(peer.take, [&] {
    w.set(LastAckCount{}, w(Count{}));
    w.set(AckCountsUntil{}, w(Now{}) + w(CountWindow{}));
    w.when(below_base > w(Acked{}), [&] { w.set(Acked{}, below_base); });
    w.when(preemptive, [&] {
      w.call(AnswerReader{});
      w.call(AnswerGoes{});
    });
    w.when(!preemptive, [&] { w.call(repeat); });
  });
}
struct AckNackArrives : Rule<Received<AckNack>> {
  template <class W>
  static void run(W& w) {
    take_acknack(w, RepeatListed{});
  }
};
struct PacketIsProcessed : Rule<Happens<PacketEnds>> {
  template <class W>
  static void run(W& w) {
    w.call(AnswerGoes{});
  }
};

using WriterSideRules = TypeList<ReaderIsMatched, HeartbeatTimerIsTaken, DescriptorIsCreated,
                                 AckNackArrives, PacketIsProcessed>;

/// The whole composition.
struct Cyclone {
  static constexpr std::string_view name = "cyclone";
  using AckNack = cyclone::AckNack;
  using Parts =
      TypeList<Judge, Peer, Pacer, Thread, AckTimer, HeartbeatTimer, SpdpTimer, ReplyTimer>;
  using Timers = TypeList<AckTime, HeartbeatTime, SpdpTime, ReplyTime, ThreadRun>;
  using State =
      TypeList<Recognised, AckDue, HeartbeatDue, SpdpDue, ReplyDue, Exists, Sent, HeartbeatCount,
               HeartbeatsSince, LastHeartbeat, HeartbeatSent, WriterOpen, Acked, LastAckCount,
               AckCountsUntil, SomeAccepted, SomeRefused, X, Known, Historic, Notified, ByDelay,
               AskedEnd, LastBase, LastHeartbeatCount, HeartbeatCountsUntil, QuietUntil, HushUntil,
               AgainAt, NextAckCount, RepliesSent>;
  /// What is counted of a stream are always its first samples, up to some number; so are these.
  using FirstSamples = TypeList<Acked>;
  using Packets = TypeList<Spdp, Data, Heartbeat, AckNack>;
  using Occasions =
      TypeList<Starts, Created, WriterOpens, ReaderOpens, PacketEnds, AckTimerFires,
               HeartbeatTimerFires, SpdpTimerFires, ReplyTimerFires, ThreadPauses, ThreadSleeps>;
  using Announcing = AnnouncingRules;
  using Exchange = Joined<WriterSideRules, ReaderSideRules, ThreadRules>;
  using Rules = Joined<Announcing, Exchange>;
  using IsOpen = WriterOpen;
  /// What a request would say now.
  static auto bitmap() { return says(Says{Listed{}, is_lacking}, Says{BelowBase{}, is_confirmed}); }
  static constexpr std::array<Unused, 0> unused{};
  static constexpr std::array from_outside{
      FromOutside{"Starts", "the application creates a participant"},
      FromOutside{"Created", "the application creates endpoints"},
      FromOutside{"PacketEnds", "the network has handed over a packet"},
  };
};

}  // namespace stormproof::fsm::composition::cyclone
