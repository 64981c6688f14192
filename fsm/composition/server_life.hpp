// Fast DDS with a Discovery Server whose clients have a life: the rules of both
// (fsm/composition/server.hpp, fastdds_life.hpp), with what is heard of whom, and what is lost of
// those that are forgotten. The server checks the leases of its clients, a client that of the
// server alone; of each other clients hear from the server that somebody is gone. A server that is
// started again keeps its name and knows nothing, not even its numbers: who has not forgotten it
// takes what it says for old news. `FastDdsServerLiving` is the whole composition. What is
// forgotten of the exchange of descriptors, and of control-only relations, is what Fast DDS forgets
// (`fastdds::FastDdsLiving`).
// Source: specs/guide/discovery-server.md, "Lives with a server".
#pragma once

#include <array>

#include "fsm/composition/fastdds_life.hpp"
#include "fsm/composition/server.hpp"

namespace stormproof::fsm::composition::server {

/// The pair's destination is in the server's database, and is not gone.
struct IsInDatabase : Answer {};

/// The HEARTBEAT that came last has a greater number than those before.
struct HeartbeatIsNew : Answer {};
/// The ACKNACK acknowledges numbers that the relay has not given yet.
struct IsAhead : Answer {};
/// Which ACKNACK of the server to announcements of clients it is, from 1 on, and which one the
/// client has heard last.
struct RegistrationNumber : Amount {};
struct RegistrationHeard : Number<owner::pair> {};

struct Needless : Occasion<owner::writer> {};  ///< a change has a number that nobody needs

/// The pair's destination forgets its source as any participant does.
struct ForgetExchange : Opaque {
  template <class W>
  static void contract(W& w) {
    w.set(Recognised{}, typename W::Bool(false));
    w.set(LeaseRuns{}, typename W::Bool(false));
    w.cancel(LeaseCheck{});
  }
};
/// The goodbye of the pair's source waits for the routine, which tells it in its name.
struct JoinGoodbyes : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// As far as its number is new.
struct TakeNew : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// The relation's reader has heard of no number.
struct ForgetRelayed : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// The reader of a relay has nothing of what is relevant for it.
struct ListAgain : Opaque {
  template <class W>
  static void contract(W& w) {
    w.feed_each(Change{}, on<change_for_reader::InitialAckNackReceived>);
  }
};
/// What a goodbye replaces, and the goodbye itself, are inserted as what is new; it may be one that
/// nobody needs.
struct UpdateWithGoodbyes : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("somebody is gone of whom nobody has heard"), [&] { w.raise(Needless{}); });
    UpdateDatabase::contract(w);
  }
};

struct HeedsWhatIsNew {
  using Take = TakeNew;
  template <class W>
  static auto heeds(W& w) {
    return w(CarriesHeartbeat{}) && w(HeartbeatIsNew{});
  }
};
using LivingLearner = LearnerRules<HeedsWhatIsNew>;

// What is heard. ----------------------------------------------------------------------------------

struct HeardRegistration : Rule<Received<Registration>> {
  template <class W>
  static void run(W& w) {
    RegistrationArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeardRegistrationHeartbeat : Rule<Received<RegistrationHeartbeat>> {
  template <class W>
  static void run(W& w) {
    RegistrationHeartbeatArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeardRegistrationAckNack : Rule<Received<RegistrationAckNack>> {
  template <class W>
  static void run(W& w) {
    w.when(w(RegistrationNumber{}) > w(RegistrationHeard{}), [&] {
      w.set(RegistrationHeard{}, w(RegistrationNumber{}));
      RegistrationAckNackArrives::run(w);
    });
    w.reverse([](auto& back) { back.call(HearFrom{}); });
  }
};
struct HeardRelayedData : Rule<Received<RelayedData>> {
  template <class W>
  static void run(W& w) {
    LivingLearner::RelayedDataArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeardRelayHeartbeat : Rule<Received<RelayHeartbeat>> {
  template <class W>
  static void run(W& w) {
    LivingLearner::RelayHeartbeatArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeardGap : Rule<Received<Gap>> {
  template <class W>
  static void run(W& w) {
    LivingLearner::GapArrives::run(w);
    w.call(HearFrom{});
  }
};
/// A reader that has seen no HEARTBEAT is a new one: it has nothing.
struct HeardRelayedAckNack : Rule<Received<RelayedAckNack>> {
  template <class W>
  static void run(W& w) {
    w.when(!w(IsAhead{}), [&] {
      w.when(w(RelayOpen{}) && w(IsInitial{}), [&] { w.perform(ListAgain{}); });
      RelayedAckNackArrives::run(w);
    });
    w.reverse([](auto& back) { back.call(HearFrom{}); });
  }
};

// What the server says of itself. -----------------------------------------------------------------

/// To everybody whom it knows, and has in its database.
struct ServerAnnounces : Rule<Due<Announcement>> {
  template <class W>
  static void run(W& w) {
    const auto timer =
        w.feed(AnnouncementTimer{}, on<announcer::AnnouncementDue>, announcer_input(w));
    w.set(AnnouncementsSent{}, w(AnnouncementsSent{}) + 1);
    w.when(timer.announce, [&] {
      w.for_known_peers([](auto& peer) {
        peer.when(peer(IsInDatabase{}), [&] {
          peer.for_streams([](auto& r) {
            r.when(r(OfAnnouncements{}), [&] { r.emit(RelayedData{}, says()); });
          });
        });
      });
      w.at(timer.next_at, Announcement{});
    });
  }
};

// Who is forgotten. -------------------------------------------------------------------------------

/// What the server has of a client closes.
struct CloseClient : Procedure {
  template <class W>
  static void body(W& w) {
    w.perform(ForgetExchange{});
    w.renew(RegistrationReply{});
    w.renew(RegistrationTimer{});
    w.set(RegistrationHeartbeatSeen{}, typename W::Bool(false));
    w.cancel(RegistrationReplyDue{});
    w.cancel(RegistrationAttempt{});
    w.reverse([](auto& back) {
      back.for_streams([](auto& r) {
        r.set(RelayOpen{}, typename W::Bool(false));
        r.renew(Change{});
        r.renew(RelaySuppression{});
        r.cancel(RelaySuppressionEnd{});
      });
    });
  }
};

/// A reader of a relay has heard of nothing.
struct CloseLearners : Procedure {
  template <class W>
  static void body(W& w) {
    w.for_streams([](auto& r) {
      r.set(LearnerOpen{}, typename W::Bool(false));
      r.set(LearnerHeartbeatSeen{}, typename W::Bool(false));
      r.renew(LearnerTimer{});
      r.renew(LearnerReply{});
      r.cancel(LearnerAttempt{});
      r.cancel(LearnerReplyDue{});
      r.perform(ForgetRelayed{});
    });
  }
};
/// What the server has of another one closes. It looks for it again if it did at its start.
struct CloseServer : Procedure {
  template <class W>
  static void body(W& w) {
    w.call(CloseClient{});
    w.call(CloseLearners{});
    w.reverse([](auto& back) {
      back.cancel(ClientSync{});
      back.when(back(Seeks{}), [&] { back.after(RoutinePeriod{}, ClientSync{}); });
    });
  }
};

/// The server forgets a client or another server, and tells the others. Since 3.0 it announces
/// itself as at its start.
struct LoseClient : Procedure {
  template <class W>
  static void body(W& w) {
    const auto from_server = w(FromServer{});
    w.when(from_server, [&] { w.call(CloseServer{}); });
    w.when(!from_server, [&] { w.call(CloseClient{}); });
    w.perform(JoinGoodbyes{});
    w.reverse([](auto& back) {
      back.when(back(KnownByLocator{}), [&] {
        back.renew(AnnouncementTimer{});
        back.set(AnnouncementsSent{}, typename W::Int(1));
        back.cancel(Announcement{});
        back.after(StartupPeriod{}, Announcement{});
      });
      back.call(WakeRoutine{});
    });
  }
};

/// A client forgets the server and nobody else: it begins as at its start, but knows the others.
struct LoseServer : Procedure {
  template <class W>
  static void body(W& w) {
    w.perform(ForgetExchange{});
    w.call(CloseLearners{});
    const auto by_locator = w(KnownByLocator{});
    w.when(!by_locator, [&] {
      w.for_streams(
          [](auto& r) { r.when(r(OfAnnouncements{}), [&] { r.raise(LearnerOpens{}); }); });
    });
    w.reverse([&](auto& client) {
      client.set(RegistrationAcknowledged{}, typename W::Bool(false));
      client.set(RegistrationHeard{}, typename W::Int(0));
      client.when(!by_locator, [&] {
        client.emit(RegistrationHeartbeat{}, says());
        arm_registration(client);
      });
      client.cancel(ClientSync{});
      client.after(ClientSyncPeriod{}, ClientSync{});
    });
  }
};

struct LeaseIsChecked : Rule<Due<LeaseCheck>> {
  template <class W>
  static void run(W& w) {
    const auto heard = w(ForgottenAt{}) > w(Now{});
    w.when(heard, [&] { w.at(w(ForgottenAt{}), LeaseCheck{}); });
    w.when(!heard, [&] {
      const auto to_server = w(ToServer{});
      w.when(to_server, [&] { w.call(LoseClient{}); });
      w.when(!to_server, [&] { w.call(LoseServer{}); });
    });
  }
};

/// As when a change has been sent to all, of whom there are none.
struct ChangeIsNeedless : Rule<Happens<Needless>> {
  template <class W>
  static void run(W& w) {
    arm(w);
  }
};

/// What a relay has to do for its readers is not to be done any more.
template <class W>
void lose_relay(W& w) {
  w.renew(RelayExpiry{});
  w.renew(RelayResponse{});
  w.cancel(RelayExpiryDue{});
  w.cancel(RelayResponseDue{});
}
/// The server has nothing of its clients, nothing in its database and its relays, and numbers all
/// that it says from 1 on. A host closes all clients and other servers, whether they are known or
/// not, before it comes to the relays.
struct LoseDatabase : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_known_peers([](auto& peer) {
      peer.reverse([](auto& back) {
        const auto from_server = back(FromServer{});
        back.when(from_server, [&] { back.call(CloseServer{}); });
        back.when(!from_server, [&] { back.call(CloseClient{}); });
      });
      peer.for_streams([](auto& r) { lose_relay(r); });
    });
  }
};
struct ServerReturns : Rule<Due<Return>> {
  template <class W>
  static void run(W& w) {
    w.renew(AnnouncementTimer{});
    w.set(AnnouncementsSent{}, typename W::Int(0));
    w.cancel(Announcement{});
    w.renew(Routine{});
    w.cancel(RoutineDue{});
    w.cancel(RoutineAgain{});
    w.renew(SendingThread{});
    w.cancel(SendingDue{});
    w.perform(LoseDatabase{});
    w.at(w(Now{}), Announcement{});
  }
};

struct FastDdsServerLiving {
  static constexpr std::string_view name = "fastdds-server-living";
  using AckNack = RelayedAckNack;
  using Parts = FastDdsServer::Parts;
  using Timers = Joined<FastDdsServer::Timers, TypeList<Announcement, LeaseCheck, Return>>;
  using State = Joined<FastDdsServer::State, TypeList<ForgottenAt, LeaseRuns, RegistrationHeard>>;
  using Packets = FastDdsServer::Packets;
  using Occasions = Joined<FastDdsServer::Occasions, TypeList<Needless>>;
  using Announcing = TypeList<ClientAnnounces, AnnouncesToServer, ClientSyncIsDue, ServersMeet,
                              HeardRegistrationAckNack, RegistrationExpires, HeardRegistration,
                              HeardRegistrationHeartbeat, RegistrationReplyIsDue,
                              RegistrationInitialDue, ServerAnnounces>;
  using Learning = TypeList<LearnerOpened, LearnerInitialDue, LearnerReplyIsDue, HeardRelayedData,
                            HeardRelayHeartbeat, HeardGap, DescriptorsArrive>;
  using Relaying = TypeList<RelayOpened, ChangeIsInserted, ChangeIsNeedless, ThreadSends,
                            ChangesAreSkipped, ChangeIsServed, ChangeIsDelivered,
                            HeardRelayedAckNack, RelayResponds, RelaySuppressionEnds, RelayExpires>;
  using Rules = Joined<Announcing, Learning, RoutineRules<UpdateWithGoodbyes>::Rules, Relaying,
                       TypeList<LeaseIsChecked, ServerReturns>>;
  using IsOpen = RelayOpen;
  static constexpr std::array unused{
      Unused{"Change", "requested", "the step that feeds it answers SomeRequested"},
      Unused{"Change", "enqueue", "the step that feeds it fills the queue"},
      Unused{"Change", "Created", "the step that gives a change its number feeds it"},
  };
  static constexpr std::array from_outside{
      FromOutside{"ClientAnnouncement", "announcement 0 is due when a participant starts"},
      FromOutside{"Return", "the server is there again when the deployment says so"},
      FromOutside{"Arrives", "a reader of the server receives what is new"},
  };
};

}  // namespace stormproof::fsm::composition::server
