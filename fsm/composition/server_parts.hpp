// What there is with a Discovery Server besides what Fast DDS has anyway: parts and who has one,
// state, packets, what only a host knows, and the steps that are stated by their contracts. The
// rules are in fsm/composition/server.hpp.
//
// A *server* is a participant; a *client*'s pair is (client, server); that of its announcements is
// the one with the first of its servers. Of two servers that know each other each is a client of
// the other, as far as it learns what the other has. A server has three
// writers, `relays`: of announcements, of publications and of subscriptions; their relations are
// those of (server, client), and what they carry are *changes*, numbered from 1.
#pragma once

#include "fsm/change_for_reader.hpp"
#include "fsm/composition/announcements.hpp"
#include "fsm/composition/packets.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/composition/single_shots.hpp"
#include "fsm/event_thread.hpp"

namespace stormproof::fsm::composition::server {

using composition::CrossHost;

// A client's announcements, which are reliable, and what the server keeps of them.
struct RegistrationExpiry : Part<SingleShot, owner::pair> {};
struct RegistrationReply : Part<SingleShot, owner::pair> {};
struct RegistrationTimer : Part<InitialAckNack, owner::pair> {};
// A client's reader of one relay.
struct LearnerReply : Part<SingleShot, owner::relation> {};
struct LearnerTimer : Part<InitialAckNack, owner::relation> {};
// The server's relays.
struct Change : Part<ChangeForReader, owner::descriptor> {};
struct RelayExpiry : Part<SingleShot, owner::writer> {};
struct RelayResponse : Part<SingleShot, owner::writer> {};
struct RelaySuppression : Part<SingleShot, owner::relation> {};
struct Routine : Part<SingleShot, owner::participant> {};
struct SendingThread : Part<EventThread, owner::participant> {};

struct ClientAnnouncement : Timer<owner::pair> {};
struct ClientSync : Timer<owner::pair> {};
struct RegistrationExpiryDue : Timer<owner::pair> {};
struct RegistrationReplyDue : TimerAtDestination<owner::pair> {};
struct RegistrationAttempt : TimerAtDestination<owner::pair> {};
struct LearnerReplyDue : TimerAtDestination<owner::relation> {};
struct LearnerAttempt : TimerAtDestination<owner::relation> {};
struct RelayExpiryDue : Timer<owner::writer> {};
struct RelayResponseDue : Timer<owner::writer> {};
struct RelaySuppressionEnd : Timer<owner::relation> {};
struct RoutineDue : Timer<owner::participant> {};
struct RoutineAgain : Timer<owner::participant> {};  ///< can be cancelled
struct SendingDue : Timer<owner::participant> {};

struct RegistrationAcknowledged : Flag<owner::pair> {};
struct RegistrationHeartbeatSeen : Flag<owner::pair> {};
struct RegistrationLastDelay : Number<owner::pair> {};
struct LearnerOpen : Flag<owner::relation> {};
struct LearnerHeartbeatSeen : Flag<owner::relation> {};
struct LearnerLastDelay : Number<owner::relation> {};
struct RelayOpen : Flag<owner::relation> {};

struct ClientSyncPeriod : DelayOf<"client_sync_period"> {};               ///< τ_T
struct RoutinePeriod : DelayOf<"server_routine_period"> {};               ///< τ_R
struct RegistrationHeartbeatPeriod : DelayOf<"pdp_heartbeat_period"> {};  ///< τ_H of announcements
struct RegistrationResponseDelay : DelayOf<"pdp_heartbeat_response_delay"> {};  ///< their τ_A
// Those of announcements or of descriptors, as the relay is.
struct RelayHeartbeatPeriod : Amount {};
struct RelayResponseDelay : Amount {};
struct RelaySuppressionDuration : Amount {};
struct LearnerResponseDelay : Amount {};

/// A client knows where the server is and not who; otherwise both.
struct KnownByLocator : SwitchOf<"server_known", "locator"> {};

/// The relay is that of announcements.
struct OfAnnouncements : Answer {};
/// The source of the pair is a server; its destination is.
struct FromServer : Answer {};
struct ToServer : Answer {};
/// The pair's source, a server, looks for its destination.
struct Seeks : Answer {};
struct HistoryNotEmpty : Answer {};
/// The DATA is the own announcement of the server that sends it.
struct TellsOfServer : Answer {};
/// The reader has not acknowledged the first change that there is, or something is in U.
struct LacksSomething : Answer {};
// What the last ACKNACK did.
struct SomeRequested : Answer {};
struct SomeListed : Answer {};
struct SomeIrrelevant : Answer {};  ///< it asks for what its reader does not need
struct SomethingToSend : Answer {};
struct SomethingUnacknowledged : Answer {};  ///< the routine has to look again
struct PacketsSent : Amount {};              ///< by the last step of the sending thread
struct SendingCost : Amount {};              ///< of these packets, ns

struct Registration : Packet<owner::pair> {};           ///< DATA(p) of a client
struct RegistrationHeartbeat : Packet<owner::pair> {};  ///< HEARTBEAT(p)
struct RegistrationAckNack : Packet<owner::pair, IsInitial> {};
/// What the sending thread serves goes with a HEARTBEAT; without one it is the server's own
/// announcement.
struct RelayedData : Packet<owner::relation, CarriesHeartbeat> {};
struct RelayHeartbeat : Packet<owner::relation, CarriesHeartbeat> {};
struct Gap : Packet<owner::relation, CarriesHeartbeat> {};
struct RelayedAckNack : Packet<owner::relation, IsInitial> {};

struct Announces : Occasion<owner::pair> {};  ///< a client announces itself to a server of it
struct Meets : Occasion<owner::pair> {};      ///< a server hears of another one for the first time
struct RelayOpens : Occasion<owner::relation> {};
struct LearnerOpens : Occasion<owner::relation> {};
struct Arrives : Occasion<owner::participant> {};  ///< a descriptor that is new to the server
struct Inserted : Occasion<owner::writer> {};      ///< a change that somebody needs
struct Skipped : Occasion<owner::relation> {};     ///< a reader is told what it need not have
struct Served : Occasion<owner::relation> {};      ///< a change is about to be sent to a reader
struct Delivered : Occasion<owner::writer> {};     ///< a change has been sent to all

/// The client announces itself to each server that it has, in their order.
struct ToEachServer : Opaque {
  template <class W>
  static void contract(W& w) {
    w.raise(Announces{});
  }
};
/// The pair's destination, a server, has heard of its source.
struct MeetServer : Opaque {
  template <class W>
  static void contract(W& w) {
    w.raise(Meets{});
  }
};
/// The client waits for the routine.
struct JoinParticipants : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// The server's readers of the client's descriptors open, as those of any participant do.
struct OpenReaders : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// Both sides of liveliness between the server and a client of another host, and of what asks for
/// types and answers.
struct OpenBuiltinSides : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// The client's writer of the relation's stream is matched with the server, as with any reader.
struct OpenOwnWriter : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// What is relevant for a new reader enters its list.
struct ListRelevant : Opaque {
  template <class W>
  static void contract(W& w) {
    w.feed_each(Change{}, on<change_for_reader::ReaderMatched>);
  }
};
/// What lies below the base leaves the list; what is asked for is noted.
struct TakeAckNack : Opaque {
  template <class W>
  static void contract(W& w) {
    w.feed_each(Change{}, on<change_for_reader::AckNackReceived>, [&](auto& d) {
      using D = typename std::remove_cvref_t<decltype(d)>::D;
      const auto below = w.choice("below the base");
      return ChangeForReaderIo::Input<D>{.listed = w.choice("asked for") && !below,
                                         .below_base = below};
    });
  }
};
/// What has been asked for joins the queue of what is sent again.
struct QueueAgain : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_readers([](auto& r) { r.feed_each(Change{}, on<change_for_reader::NackResponseDue>); });
  }
};
struct EndSuppression : Opaque {
  template <class W>
  static void contract(W& w) {
    w.feed_each(Change{}, on<change_for_reader::SuppressionEnded>);
  }
};
/// Who has acknowledged what, who has to learn what: what is to be sent gets a new number.
struct UpdateDatabase : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("somebody has to learn an item"), [&] { w.raise(Inserted{}); });
  }
};
/// The next change that somebody wants is sent to everybody who does; who has never been sent it is
/// told before what it does not need.
struct DeliverNext : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("somebody wants a change that is queued"), [&] {
      w.for_readers([](auto& r) {
        r.when(r.choice("it is sent that for the first time, and does not need one before it"),
               [&] { r.raise(Skipped{}); });
      });
      w.for_readers([](auto& r) {
        r.when(r.choice("it wants it"), [&] {
          r.feed(Change{}, on<change_for_reader::Serialized>);
          r.raise(Served{});
        });
      });
      w.raise(Delivered{});
    });
  }
};
/// What a DATA or GAP says is noted, and DATA is learned.
struct TakeRelayed : Opaque {
  template <class W>
  static void contract(W&) {}
};

}  // namespace stormproof::fsm::composition::server
