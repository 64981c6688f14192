// Cyclone DDS whose participants have a life: its rules (fsm/composition/cyclone.hpp), with leases,
// what is lost of those that are forgotten, the liveliness samples that go on for ever, samples
// that exist no more, endpoints that are deleted, and participants that leave. `CycloneLiving` is
// the whole composition. Of what nothing happens to its discovery is that of `Cyclone`. Source:
// specs/guide/cyclone-life.md.
#pragma once

#include "fsm/composition/cyclone.hpp"
#include "fsm/composition/cyclone_life_parts.hpp"

namespace stormproof::fsm::composition::cyclone {

struct LivingThreadRuns : RunOfThread<LivingWork> {};

// Sides of relations that close, and participants that are forgotten. ----------------------------

/// The reader side is a new one, and nothing is due for it.
struct ReaderIsClosed : Rule<Happens<ReaderCloses>> {
  template <class W>
  static void run(W& w) {
    const auto nobody = [](auto& d) { return !everyone(d); };
    w.renew(Judge{});
    w.renew(AckTimer{});
    w.cancel(AckTime{});
    w.perform(LeaveList{});
    w.set_each(X{}, nobody);
    w.set_each(Known{}, nobody);
    w.set_each(Historic{}, nobody);
    w.set_each(Notified{}, nobody);
    w.set_each(Passed{}, nobody);
    w.set(ByDelay{}, typename W::Bool(false));
    w.set(AskedEnd{}, typename W::Int(0));
    w.set(LastBase{}, typename W::Int(0));
    w.set(LastHeartbeatCount{}, typename W::Int(0));
    w.set(HeartbeatCountsUntil{}, typename W::Int(0));
    w.set(QuietUntil{}, typename W::Int(0));
    w.set(HushUntil{}, typename W::Int(0));
    w.set(AgainAt{}, typename W::Int(0));
    w.set(NextAckCount{}, typename W::Int(0));
  }
};
/// The reader leaves the list of the writer, whose HEARTBEATs go on for the others.
struct WriterIsClosed : Rule<Happens<WriterCloses>> {
  template <class W>
  static void run(W& w) {
    w.renew(Peer{});
    w.set(WriterOpen{}, typename W::Bool(false));
    w.set(Acked{}, typename W::Int(0));
    w.set(LastAckCount{}, typename W::Int(0));
    w.set(AckCountsUntil{}, typename W::Int(0));
    w.perform(DropAcknowledged{});
  }
};

/// The pair's destination forgets its source: as reader, as writer, and whom it still answers.
struct ForgetSource : Procedure {
  template <class W>
  static void body(W& w) {
    w.set(Recognised{}, typename W::Bool(false));
    w.for_streams([](auto& r) {
      r.raise(ReaderCloses{});
      r.reverse([](auto& back) { back.raise(WriterCloses{}); });
    });
    w.perform(CloseAllTopics{});
    w.reverse([](auto& back) {
      back.renew(ReplyTimer{});
      back.cancel(ReplyTime{});
      back.set(RepliesSent{}, typename W::Int(0));
    });
  }
};
/// The pair's destination looks after the addresses that it announces itself to.
struct MoveAddressTimer : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(w(NextAddress{}) > 0,
           [&] { move<AddressTimer, AddressDue, AddressTime>(w, w(NextAddress{})); });
  }
};

/// A packet of the pair's source has reached its destination: at the deadline it is too late.
struct PacketIsHeard : Rule<Happens<PacketBegins>> {
  template <class W>
  static void run(W& w) {
    w.when(w(Recognised{}) && w(ForgottenAt{}) > w(Now{}),
           [&] { w.set(ForgottenAt{}, w(Now{}) + w(LeaseDuration{})); });
  }
};
struct LeaseIsChecked : Rule<Due<LeaseCheck>> {
  template <class W>
  static void run(W& w) {
    const auto heard = w(Recognised{}) && w(ForgottenAt{}) > w(Now{});
    w.when(heard, [&] { w.at(w(ForgottenAt{}), LeaseCheck{}); });
    w.when(!heard, [&] {
      w.set(LeaseRuns{}, typename W::Bool(false));
      w.when(w(Recognised{}), [&] {
        w.call(ForgetSource{});
        w.perform(LetAddressAge{});
        w.reverse([](auto& back) { back.call(MoveAddressTimer{}); });
      });
    });
  }
};

// Announcements. ----------------------------------------------------------------------------------

struct LivingAnnouncementArrives : Rule<Received<Spdp>> {
  template <class W>
  static void run(W& w) {
    w.when(w(IsGoodbye{}) && w(Recognised{}), [&] {
      w.call(ForgetSource{});
      w.perform(DropAddress{});
      w.reverse([](auto& back) { back.call(MoveAddressTimer{}); });
    });
    w.when(!w(IsGoodbye{}) && !w(Recognised{}), [&] {
      w.set(ForgottenAt{}, w(Now{}) + w(LeaseDuration{}));
      w.when(!w(LeaseRuns{}), [&] {
        w.set(LeaseRuns{}, typename W::Bool(true));
        w.at(w(ForgottenAt{}), LeaseCheck{});
      });
      w.perform(KeepAddress{});
      recognise(w);
    });
  }
};
struct LivingStarts : Rule<Happens<Starts>> {
  template <class W>
  static void run(W& w) {
    w.perform(AnnounceEverywhere{});
    w.call(Wake{});
    move<SpdpTimer, SpdpDue, SpdpTime>(w, w(Now{}) + w(SpdpStartupPeriod{}));
    move<LivelinessTimer, LivelinessDue, LivelinessTime>(w, w(Now{}) + w(LivelinessPeriod{}));
    w.call(MoveAddressTimer{});
  }
};
struct LivingSpdpTimerIsTaken : Rule<Happens<SpdpTimerFires>> {
  template <class W>
  static void run(W& w) {
    w.feed(SpdpTimer{}, on<movable_timer::Taken>);
    w.perform(Announce{});
    w.call(Wake{});
    move<SpdpTimer, SpdpDue, SpdpTime>(w, w(Now{}) + w(AnnouncingPeriod{}));
  }
};
struct LivingReplyTimerIsTaken : NextReply<RepliesDue> {};
struct AddressTimeHasCome : Rule<Due<AddressTime>> {
  template <class W>
  static void run(W& w) {
    come<AddressTimer, AddressDue>(w, [&] { w.call(Wake{}); });
  }
};
struct AddressTimerIsTaken : Rule<Happens<AddressTimerFires>> {
  template <class W>
  static void run(W& w) {
    w.feed(AddressTimer{}, on<movable_timer::Taken>);
    w.perform(AgeAddresses{});
    w.call(Wake{});
    w.call(MoveAddressTimer{});
  }
};

// The liveliness writer. --------------------------------------------------------------------------

struct LivelinessTimeHasCome : Rule<Due<LivelinessTime>> {
  template <class W>
  static void run(W& w) {
    come<LivelinessTimer, LivelinessDue>(w, [&] { w.call(Wake{}); });
  }
};
struct LivelinessTimerIsTaken : Rule<Happens<LivelinessTimerFires>> {
  template <class W>
  static void run(W& w) {
    w.feed(LivelinessTimer{}, on<movable_timer::Taken>);
    w.perform(WriteLiveliness{});
    move<LivelinessTimer, LivelinessDue, LivelinessTime>(w, w(Now{}) + w(LivelinessPeriod{}));
  }
};
/// A sample takes the place of the one before, and goes out at once, a HEARTBEAT right behind it.
struct LivelinessIsSaid : Rule<Happens<LivelinessWritten>> {
  template <class W>
  static void run(W& w) {
    w.set_each(Gone{}, [](auto& d) { return d(Exists{}); });
    w.set(Exists{}, typename W::Bool(true));
    const auto has_readers = w(HasReaders{});
    w.when(!has_readers, [&] { w.set(Sent{}, typename W::Bool(true)); });
    w.when(has_readers, [&] {
      w.call(PacerGoesOn{}, pace<heartbeat_pacer::Hastened>(w));
      const auto adds = !(w(PiggybackDelay{}) > w(LivelinessPeriod{}));
      w.perform(SayLiveliness{});
      w.when(adds, [&] {
        w.set(HeartbeatCount{}, w(HeartbeatCount{}) + 1);
        w.perform(HeartbeatToAll{});
        w.set(LastHeartbeat{}, w(Now{}));
        w.set(HeartbeatSent{}, typename W::Bool(true));
        w.set(HeartbeatsSince{}, w(HeartbeatsSince{}) + 1);
      });
      w.perform(CompletePacket{});
    });
  }
};

// Samples that exist no more. ---------------------------------------------------------------------

/// In sample order, and what exists no more is passed over.
inline constexpr auto follow_endpoint = [](auto& d) {
  using Bool = typename std::remove_cvref_t<decltype(d)>::Bool;
  d.set(Notified{}, Bool(true));
  d.when(!d(Passed{}), [&] { d.perform(FollowEndpoint{}); });
};
/// The reader hears that samples exist no more: as if it had received them.
template <class Field, class W>
void pass_over(W& w) {
  w.when(!w.in(Judge{}, is<cautious_reader::Closed>), [&] {
    w.set_each(Passed{}, [](auto& d) { return d(Passed{}) || (d(Field{}) && !d(X{})); });
    w.set_each(X{}, [](auto& d) { return d(X{}) || d(Field{}); });
    w.for_descriptors([](auto& d) { return !d(Notified{}) && can_be_told(d); }, follow_endpoint);
  });
}
struct LivingDataArrives : Rule<Received<Data>> {
  template <class W>
  static void run(W& w) {
    take_data(w, follow_endpoint);
  }
};
struct LivingHeartbeatArrives : Rule<Received<Heartbeat>> {
  template <class W>
  static void run(W& w) {
    pass_over<BelowFirst>(w);
    take_heartbeat(w);
  }
};
struct GapArrives : Rule<Received<Gap>> {
  template <class W>
  static void run(W& w) {
    pass_over<Lists>(w);
  }
};
/// A pre-emptive ACKNACK is repeated more and more rarely.
struct LivingAckTimerIsTaken : Rule<Happens<AckTimerFires>> {
  template <class W>
  static void run(W& w) {
    const auto reader = answer(w);
    w.when(reader.preempt,
           [&] { move<AckTimer, AckDue, AckTime>(w, w(Now{}) + w(PreEmptiveInterval{})); });
    w.when(!reader.preempt, [&] { w.call(MoveAckTimer{}, reader); });
  }
};
struct LivingReaderIsOpened : Rule<Happens<ReaderOpens>> {
  template <class W>
  static void run(W& w) {
    w.when(w.in(Judge{}, is<cautious_reader::Closed>), [&] { w.set(OpenedAt{}, w(Now{})); });
    ReaderIsOpened::run(w);
  }
};

/// What exists no more is not repeated: one GAP says so.
struct RepeatWhatExists : Procedure {
  template <class W>
  static void body(W& w) {
    const auto each = [](auto& d) {
      const auto gone = d(Gone{});
      d.when(gone, [&] {
        d.set(IsMissed{}, typename W::Bool(true));
        d.set(SomeAccepted{}, typename W::Bool(true));
      });
      d.when(!gone, [&] { repeat(d); });
    };
    repeat_listed(w, each, [&] {
      w.when(w.some([](auto& d) { return d(IsMissed{}); }), [&] {
        w.emit(Gap{}, says(Says{Lists{}, [](auto& d) { return d(IsMissed{}); }}));
        w.call(Wake{});
        w.set_each(IsMissed{}, [](auto& d) { return !everyone(d); });
      });
    });
  }
};
struct LivingAckNackArrives : Rule<Received<AckNack>> {
  template <class W>
  static void run(W& w) {
    take_acknack(w, RepeatWhatExists{});
    w.perform(DropAcknowledged{});
  }
};

// Endpoints that are deleted, and participants that leave. ----------------------------------------

/// The sample says that an endpoint exists no more. It is kept until all readers have it.
struct EndpointIsDeleted : Rule<Happens<Deleted>> {
  template <class W>
  static void run(W& w) {
    w.perform(CloseTopics{});
    w.set(Exists{}, typename W::Bool(true));
    const auto has_readers = w(HasReaders{});
    w.when(!has_readers, [&] {
      w.set(Sent{}, typename W::Bool(true));
      w.set(Gone{}, typename W::Bool(true));
    });
    w.when(has_readers, [&] {
      w.call(PacerGoesOn{}, pace<heartbeat_pacer::Hastened>(w));
      w.perform(DataToAll{});
      w.call(Wake{});
    });
  }
};
/// No timer of it fires any more; what is queued still goes out.
struct ParticipantLeaves : Rule<Happens<Leaves>> {
  template <class W>
  static void run(W& w) {
    w.perform(LoseTimers{});
    w.perform(SayGoodbye{});
    w.call(Wake{});
  }
};

/// The whole composition.
struct CycloneLiving {
  static constexpr std::string_view name = "cyclone-living";
  using AckNack = cyclone::AckNack;
  using Parts = Joined<Cyclone::Parts, TypeList<LivelinessTimer, AddressTimer>>;
  using Timers = Joined<Cyclone::Timers, TypeList<LeaseCheck, LivelinessTime, AddressTime>>;
  using State = Joined<Cyclone::State, TypeList<ForgottenAt, LeaseRuns, LivelinessDue, AddressDue,
                                                Gone, Passed, IsMissed, OpenedAt>>;
  using FirstSamples = Cyclone::FirstSamples;
  using Packets = TypeList<Spdp, Data, Heartbeat, AckNack, Gap>;
  using Occasions = Joined<Cyclone::Occasions,
                           TypeList<PacketBegins, ReaderCloses, WriterCloses, Deleted, Leaves,
                                    LivelinessWritten, LivelinessTimerFires, AddressTimerFires>>;
  using Announcing = TypeList<LivingStarts, LivingSpdpTimerIsTaken, LivingReplyTimerIsTaken,
                              LivingAnnouncementArrives>;
  using Rules = Joined<
      Announcing,
      TypeList<ReaderIsMatched, HeartbeatTimerIsTaken, DescriptorIsCreated, LivingAckNackArrives,
               PacketIsProcessed, LivingReaderIsOpened, LivingDataArrives, LivingHeartbeatArrives,
               LivingAckTimerIsTaken>,
      TypeList<LivingThreadRuns, CopyIsSent, NothingIsLeft, HeartbeatTimeHasCome, AckTimeHasCome,
               SpdpTimeHasCome, ReplyTimeHasCome>,
      TypeList<ReaderIsClosed, WriterIsClosed, PacketIsHeard, LeaseIsChecked, AddressTimeHasCome,
               AddressTimerIsTaken, LivelinessTimeHasCome, LivelinessTimerIsTaken, LivelinessIsSaid,
               GapArrives, EndpointIsDeleted, ParticipantLeaves>>;
  using IsOpen = WriterOpen;
  static constexpr auto unused = Cyclone::unused;
  static constexpr std::array from_outside{
      FromOutside{"Starts", "the application creates a participant"},
      FromOutside{"Created", "the application creates endpoints"},
      FromOutside{"Deleted", "the application deletes endpoints"},
      FromOutside{"Leaves", "the application deletes a participant"},
      FromOutside{"PacketBegins", "the network hands over a packet"},
      FromOutside{"PacketEnds", "the network has handed over a packet"},
  };
};

}  // namespace stormproof::fsm::composition::cyclone
