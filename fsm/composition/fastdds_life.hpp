// Fast DDS whose participants have a life: its rules (fsm/composition/fastdds.hpp), with what is
// heard of others, and what is lost of those that are forgotten or come back. `FastDdsLiving` is
// the whole composition. Of what nobody forgets its runs are those of `FastDds`.
// Source: specs/guide/museum.md, "Participants that come and go"; specs/guide/fastdds.md.
#pragma once

#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/life.hpp"

namespace stormproof::fsm::composition::fastdds {

/// The other end of a control-only relation is heard of: its writer, or its reader.
struct HearWriter : Opaque {
  template <class W>
  static void contract(W& w) {
    w.call(HearFrom{});
  }
};
struct HearReader : Opaque {
  template <class W>
  static void contract(W& w) {
    w.reverse([](auto& back) { back.call(HearFrom{}); });
  }
};

/// Which ACKNACK of its reader's participant on the stream it is, from 1 on, if that may come back
/// under its name having forgotten how many there were; 0: of anybody else. And which one the
/// writer has heard last.
struct AckNackNumber : Amount {};
struct AckNackHeard : Number<owner::relation> {};

/// The sides that the pair's source has of control-only relations with its destination are new
/// ones.
struct ForgetTopics : Opaque {
  using ForgetsTopics = ForgetTopics;

  template <class W>
  static void contract(W& w) {
    w.renew(control::ControlWriterSide{});
    forget_reader(w);
  }
  template <class W>
  static void forget_reader(W& w) {
    w.renew(control::ControlReaderSide{});
    w.renew(control::ControlInitialTimer{});
    w.renew(control::ControlReply{});
    w.set(control::ControlHeartbeatSeen{}, typename W::Bool(false));
    w.cancel(control::ControlInitialAttempt{});
    w.cancel(control::ControlReplyDue{});
  }
};

/// What Fast DDS has besides that is forgotten: the nack response and the asynchronous queue go on
/// for those that are not. Who comes back has no endpoints. Nobody forgets where types are asked
/// for.
struct Forgetting {
  using Descriptor = fastdds::C;
  using WriterOpen = fastdds::WriterOpen;
  using SuppressionEnd = fastdds::SuppressionEnd;

  template <class W>
  static void forget_writer(W& w) {
    w.renew(Reply{});
    w.set_each(Known{}, [](auto& d) { return !everyone(d); });
    w.set_each(HandedOver{}, [](auto& d) { return !everyone(d); });
  }
  template <class W>
  static void forget_reader(W& w) {
    w.renew(Suppression{});
    w.set(SomeConfirmed{}, typename W::Bool(false));
    w.set(AckNackHeard{}, typename W::Int(0));
  }
  template <class W>
  static void forget_peer(W& w) {
    w.perform(ForgetTopics{});
  }
  template <class W>
  static void lose_participant(W& w) {
    w.renew(AsyncRun{});
    w.cancel(AsyncRunDue{});
  }
  template <class W>
  static void lose_writer(W& w) {
    w.set_each(Exists{}, [](auto& d) { return !everyone(d); });
    w.set_each(Enqueued{}, [](auto& d) { return !everyone(d); });
    w.renew(NackResponse{});
    w.cancel(NackResponseDue{});
  }
};
using Life = LifeRules<Forgetting>;

// What is heard. ----------------------------------------------------------------------------------

using LivingAnnouncements = AnnouncementRules<Implementation>;
using LivingReader = ReaderRules<Implementation>;

struct HeardMulticast : Rule<Received<SpdpMulticast>> {
  template <class W>
  static void run(W& w) {
    LivingAnnouncements::MulticastArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeardUnicast : Rule<Received<SpdpUnicast>> {
  template <class W>
  static void run(W& w) {
    LivingAnnouncements::UnicastArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeardData : Rule<Received<Data>> {
  template <class W>
  static void run(W& w) {
    LivingReader::DataArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeardHeartbeat : Rule<Received<Heartbeat>> {
  template <class W>
  static void run(W& w) {
    LivingReader::HeartbeatArrives::run(w);
    w.call(HearFrom{});
  }
};
/// One that has been heard before, by its number, is ignored.
struct HeardAckNack : Rule<Received<AckNack>> {
  template <class W>
  static void run(W& w) {
    w.reverse([](auto& back) { back.call(HearFrom{}); });
    const auto number = w(AckNackNumber{});
    w.when(!(number > 0) || number > w(AckNackHeard{}), [&] {
      w.set(AckNackHeard{}, number);
      AckNackArrives::run(w);
    });
  }
};
struct HeardControlHeartbeat : Rule<Received<control::UserHeartbeat>> {
  template <class W>
  static void run(W& w) {
    w.perform(HearWriter{});
    control::ControlHeartbeatArrives::run(w);
  }
};
struct HeardControlAckNack : Rule<Received<control::UserAckNack>> {
  template <class W>
  static void run(W& w) {
    w.perform(HearReader{});
    control::ControlAckNackArrives::run(w);
  }
};

/// The whole composition.
struct FastDdsLiving : Implementation {
  static constexpr std::string_view name = "fastdds-living";
  /// What was before the run: all descriptors of the relation's writer exist, and it believes that
  /// the reader has them.
  template <class W>
  static void was_acknowledged(W& w) {
    w.set_each(fastdds::Exists{}, everyone);
    w.feed_each(C{}, on<change_for_reader::ReaderMatched>);
    w.feed_each(C{}, on<change_for_reader::AckNackReceived>, [](auto& d) {
      using D = typename std::remove_cvref_t<decltype(d)>::D;
      return ChangeForReaderIo::Input<D>{.listed = !everyone(d), .below_base = everyone(d)};
    });
    w.set(WriterOpen{}, typename W::Bool(true));
    w.set(SomeConfirmed{}, typename W::Bool(true));
  }
  /// The reader has everything.
  template <class W>
  static void was_received(W& w) {
    w.set_each(X{}, everyone);
    w.set_each(Known{}, everyone);
    w.set_each(fastdds::HandedOver{}, everyone);
    w.set(HeartbeatSeen{}, typename W::Bool(true));
  }
  using AckNack = fastdds::AckNack;
  using Parts = FastDds::Parts;
  using Timers = Joined<FastDds::Timers, TypeList<LeaseCheck, Return>>;
  using State = Joined<FastDds::State, TypeList<ForgottenAt, LeaseRuns, AckNackHeard>>;
  using Packets = FastDds::Packets;
  using Occasions = FastDds::Occasions;
  using Rules = Joined<
      TypeList<LivingAnnouncements::AnnouncementIsDue, HeardMulticast, HeardUnicast,
               LivingReader::ReaderOpened, LivingReader::InitialAckNackDue, HeardData,
               HeardHeartbeat, LivingReader::AckNackDue, ReaderIsMatched, DescriptorIsCreated,
               HeardAckNack, NackResponds, QueueIsSent, SuppressionEnds>,
      Clock::Rules,
      TypeList<control::ControlWriterOpened, control::ControlReaderOpened, HeardControlHeartbeat,
               HeardControlAckNack, control::ControlInitialAckNackDue, control::ControlReplyIsDue>,
      lookup::Rules, Life::Rules>;
  using IsOpen = WriterOpen;
  using IsQueued = Enqueued;
  static constexpr auto unused = FastDds::unused;
  static constexpr std::array from_outside{
      participant_returns, FromOutside{"Created", "the application creates endpoints"}};
};

}  // namespace stormproof::fsm::composition::fastdds
