// Fast DDS with a Discovery Server (specs/guide/discovery-server.md, executed by
// model/fastdds/server_protocol.hpp). Participants are clients: each announces itself to the server
// alone, matches its endpoints with those of the server at a tick, and learns about the others from
// the server, whose routine finds out what each of them needs. The writers and readers of a
// client's descriptors are those of Fast DDS (fsm/composition/fastdds.hpp).
#pragma once

#include <array>

#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/server_parts.hpp"

namespace stormproof::fsm::composition::server {

using RegistrationAttempts = InitialAttempts<RegistrationTimer, RegistrationHeartbeatSeen,
                                             RegistrationLastDelay, RegistrationAttempt>;
using LearnerAttempts =
    InitialAttempts<LearnerTimer, LearnerHeartbeatSeen, LearnerLastDelay, LearnerAttempt>;

template <class W>
void arm_registration(W& w) {
  request<RegistrationExpiry, RegistrationHeartbeatPeriod, RegistrationExpiryDue>(w);
}
template <class W>
void arm(W& w) {
  request<RelayExpiry, RelayHeartbeatPeriod, RelayExpiryDue>(w);
}
template <class W>
void relay_heartbeat(W& w) {
  w.emit(RelayHeartbeat{}, says(Says{CarriesHeartbeat{}, typename W::Bool(true)}));
}

// A client. ---------------------------------------------------------------------------------------

struct ClientAnnounces : Rule<Due<ClientAnnouncement>> {
  template <class W>
  static void run(W& w) {
    const auto timer =
        w.feed(AnnouncementTimer{}, on<announcer::AnnouncementDue>, announcer_input(w));
    w.set(AnnouncementsSent{}, w(AnnouncementsSent{}) + 1);
    w.when(timer.announce, [&] {
      w.perform(ToEachServer{});
      w.at(timer.next_at, ClientAnnouncement{});
    });
  }
};
/// To one server of those that it has. The first time it begins to look for it.
struct AnnouncesToServer : Rule<Happens<Announces>> {
  template <class W>
  static void run(W& w) {
    const auto first = !(w(AnnouncementsSent{}) > 1);
    w.when(first, [&] { begin(w); });
    w.when(!first, [&] { w.emit(Registration{}, says()); });
  }

 private:
  template <class W>
  static void begin(W& w) {
    w.when(!w(KnownByLocator{}), [&] {
      w.reverse([](auto& back) {
        back.for_streams(
            [](auto& r) { r.when(r(OfAnnouncements{}), [&] { r.raise(LearnerOpens{}); }); });
      });
      w.emit(RegistrationHeartbeat{}, says());
      w.emit(Registration{}, says());
      arm_registration(w);
    });
    w.after(ClientSyncPeriod{}, ClientSync{});
  }
};

/// Only here does a client that knows the server match its endpoints with the server's. A server
/// that looks for another one announces itself to it until it knows it.
struct ClientSyncIsDue : Rule<Due<ClientSync>> {
  template <class W>
  static void run(W& w) {
    const auto from_server = w(FromServer{});
    w.when(from_server, [&] { look_for_server(w); });
    w.when(!from_server, [&] { match(w); });
  }

 private:
  template <class W>
  static void look_for_server(W& w) {
    w.reverse([](auto& back) {
      back.when(!back(Recognised{}), [&] {
        back.for_streams([](auto& r) {
          r.when(r(OfAnnouncements{}) && !r(LearnerOpen{}), [&] { r.raise(LearnerOpens{}); });
        });
        back.reverse([](auto& self) {
          self.for_streams([](auto& r) {
            r.when(r(OfAnnouncements{}), [&] { r.emit(RelayedData{}, says()); });
          });
          self.after(RoutinePeriod{}, ClientSync{});
        });
      });
    });
  }
  template <class W>
  static void match(W& w) {
    w.reverse([](auto& back) {
      const auto known = back(Recognised{});
      back.when(!known, [&] {
        back.reverse([](auto& client) {
          client.emit(Registration{}, says());
          client.after(ClientSyncPeriod{}, ClientSync{});
        });
      });
      back.when(known, [&] {
        back.for_streams([](auto& r) {
          r.when(!r(OfAnnouncements{}), [&] {
            r.perform(OpenOwnWriter{});
            r.raise(LearnerOpens{});
          });
        });
      });
    });
  }
};

struct RegistrationAckNackArrives : Rule<Received<RegistrationAckNack>> {
  template <class W>
  static void run(W& w) {
    const auto initial = w(IsInitial{});
    w.when(initial, [&] {
      w.reverse([](auto& back) {
        back.when(back(Recognised{}) || !back(KnownByLocator{}), [&] {
          back.reverse([](auto& client) {
            client.emit(RegistrationHeartbeat{}, says());
            arm_registration(client);
          });
        });
      });
    });
    w.when(!initial, [&] { w.set(RegistrationAcknowledged{}, typename W::Bool(true)); });
  }
};

struct RegistrationExpires : Rule<Due<RegistrationExpiryDue>> {
  template <class W>
  static void run(W& w) {
    expire<RegistrationExpiry>(w, [&] {
      w.when(!w(RegistrationAcknowledged{}), [&] {
        w.emit(RegistrationHeartbeat{}, says());
        arm_registration(w);
      });
    });
  }
};

struct LearnerOpened : Rule<Happens<LearnerOpens>> {
  template <class W>
  static void run(W& w) {
    w.set(LearnerOpen{}, typename W::Bool(true));
    LearnerAttempts::open(w);
  }
};

struct LearnerInitialDue : Rule<Due<LearnerAttempt>> {
  template <class W>
  static void run(W& w) {
    LearnerAttempts::attempt(w, [&] {
      w.emit(RelayedAckNack{}, says(Says{IsInitial{}, typename W::Bool(true)}));
    });
  }
};

struct LearnerReplyIsDue : Rule<Due<LearnerReplyDue>> {
  template <class W>
  static void run(W& w) {
    expire<LearnerReply>(w, [&] { w.emit(RelayedAckNack{}, says()); });
  }
};

/// What a client's readers do with DATA, GAPs and HEARTBEATs. `C` says
///   C::Take       the step that notes what they say
///   C::heeds(w)   whether the packet's HEARTBEAT, if it has one, counts
template <class C>
struct LearnerRules {
  struct TakePacket : Procedure {
    template <class W>
    static void body(W& w) {
      w.when(w(LearnerOpen{}), [&] {
        w.perform(typename C::Take{});
        w.when(C::heeds(w) && !w(RunEnds{}), [&] {
          w.set(LearnerHeartbeatSeen{}, typename W::Bool(true));
          request<LearnerReply, LearnerResponseDelay, LearnerReplyDue>(w);
        });
      });
    }
  };
  /// Who knows the server by its locator reads nothing before the server's own announcement.
  struct RelayedDataArrives : Rule<Received<RelayedData>> {
    template <class W>
    static void run(W& w) {
      const auto to_server = w(ToServer{});
      const auto of_server = w(TellsOfServer{});
      w.when(w(KnownByLocator{}) && of_server && !to_server && !w(LearnerOpen{}), [&] {
        w.raise(LearnerOpens{});
        w.reverse([](auto& client) {
          client.emit(RegistrationHeartbeat{}, says());
          arm_registration(client);
        });
      });
      w.when(to_server && of_server && !w(Recognised{}), [&] { w.perform(MeetServer{}); });
      w.call(TakePacket{});
    }
  };
  struct RelayHeartbeatArrives : Rule<Received<RelayHeartbeat>> {
    template <class W>
    static void run(W& w) {
      w.call(TakePacket{});
    }
  };
  struct GapArrives : Rule<Received<Gap>> {
    template <class W>
    static void run(W& w) {
      w.call(TakePacket{});
    }
  };
  using Rules = TypeList<RelayedDataArrives, RelayHeartbeatArrives, GapArrives>;
};
struct HeedsAll {
  using Take = TakeRelayed;
  template <class W>
  static auto heeds(W& w) {
    return w(CarriesHeartbeat{});
  }
};

// The server and its clients' announcements. ------------------------------------------------------

/// The routine runs at once instead of later.
struct WakeRoutine : Procedure {
  template <class W>
  static void body(W& w) {
    w.cancel(RoutineAgain{});
    request<Routine, Immediately, RoutineDue>(w);
  }
};

struct OpenBuiltin : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(w(CrossHost{}) || w(lookup::LooksUpTypes{}), [&] { w.perform(OpenBuiltinSides{}); });
  }
};

/// The first one of a client; later ones renew a lease, which is not modelled. Who knows the server
/// by its locator is answered at once.
struct RegistrationArrives : Rule<Received<Registration>> {
  template <class W>
  static void run(W& w) {
    w.when(!w(Recognised{}), [&] {
      w.set(Recognised{}, typename W::Bool(true));
      w.perform(JoinParticipants{});
      RegistrationAttempts::open(w);
      w.reverse([](auto& back) {
        back.for_streams(
            [](auto& r) { r.when(r(OfAnnouncements{}), [&] { r.raise(RelayOpens{}); }); });
      });
      const auto by_locator = w(KnownByLocator{});
      w.when(by_locator, [&] { w.call(OpenBuiltin{}); });
      w.perform(OpenReaders{});
      w.reverse([](auto& back) {
        back.for_streams(
            [](auto& r) { r.when(!r(OfAnnouncements{}), [&] { r.raise(RelayOpens{}); }); });
      });
      w.when(!by_locator, [&] { w.call(OpenBuiltin{}); });
      w.reverse([&](auto& back) {
        back.when(by_locator, [&] {
          back.for_streams([](auto& r) {
            r.when(r(OfAnnouncements{}), [&] { r.emit(RelayedData{}, says()); });
          });
        });
        back.call(WakeRoutine{});
      });
    });
  }
};

/// The pair's destination takes its source for a client that learns everything, and reads what that
/// has.
struct ServersMeet : Rule<Happens<Meets>> {
  template <class W>
  static void run(W& w) {
    w.set(Recognised{}, typename W::Bool(true));
    w.perform(JoinParticipants{});
    w.for_streams([](auto& r) { r.when(!r(LearnerOpen{}), [&] { r.raise(LearnerOpens{}); }); });
    w.reverse([](auto& back) { back.for_streams([](auto& r) { r.raise(RelayOpens{}); }); });
    w.call(OpenBuiltin{});
    w.reverse([](auto& back) { back.call(WakeRoutine{}); });
  }
};

struct RegistrationHeartbeatArrives : Rule<Received<RegistrationHeartbeat>> {
  template <class W>
  static void run(W& w) {
    w.when(w(Recognised{}), [&] {
      w.set(RegistrationHeartbeatSeen{}, typename W::Bool(true));
      request<RegistrationReply, RegistrationResponseDelay, RegistrationReplyDue>(w);
    });
  }
};

struct RegistrationReplyIsDue : Rule<Due<RegistrationReplyDue>> {
  template <class W>
  static void run(W& w) {
    expire<RegistrationReply>(w, [&] { w.emit(RegistrationAckNack{}, says()); });
  }
};

struct RegistrationInitialDue : Rule<Due<RegistrationAttempt>> {
  template <class W>
  static void run(W& w) {
    RegistrationAttempts::attempt(w, [&] {
      w.emit(RegistrationAckNack{}, says(Says{IsInitial{}, typename W::Bool(true)}));
    });
  }
};

// The routine. ------------------------------------------------------------------------------------

struct DescriptorsArrive : Rule<Happens<Arrives>> {
  template <class W>
  static void run(W& w) {
    w.call(WakeRoutine{});
  }
};

/// `Update` is the step of the database.
template <class Update>
struct RoutineRules {
  struct RunRoutine : Procedure {
    template <class W>
    static void body(W& w) {
      w.perform(Update{});
      w.when(w(SomethingUnacknowledged{}), [&] { w.after(RoutinePeriod{}, RoutineAgain{}); });
    }
  };
  struct RoutineRuns : Rule<Due<RoutineDue>> {
    template <class W>
    static void run(W& w) {
      expire<Routine>(w, [&] { w.call(RunRoutine{}); });
    }
  };
  struct RoutineRunsAgain : Rule<Due<RoutineAgain>> {
    template <class W>
    static void run(W& w) {
      w.call(RunRoutine{});
    }
  };
  using Rules = TypeList<RoutineRuns, RoutineRunsAgain>;
};

// The server's relays. ----------------------------------------------------------------------------

struct StartSending : Procedure {
  template <class W>
  static void body(W& w) {
    const auto thread = w.feed(SendingThread{}, on<event_thread::Woken>, {.now = w(Now{})});
    w.when(thread.schedule, [&] { w.at(thread.next_at, SendingDue{}); });
  }
};

struct RelayOpened : Rule<Happens<RelayOpens>> {
  template <class W>
  static void run(W& w) {
    w.set(RelayOpen{}, typename W::Bool(true));
    w.perform(ListRelevant{});
    w.when(w(HistoryNotEmpty{}), [&] { arm(w); });
    relay_heartbeat(w);
  }
};

struct ChangeIsInserted : Rule<Happens<Inserted>> {
  template <class W>
  static void run(W& w) {
    w.call(StartSending{});
  }
};

struct ThreadSends : Rule<Due<SendingDue>> {
  template <class W>
  static void run(W& w) {
    const auto thread = w.feed(SendingThread{}, on<event_thread::RunDue>);
    w.when(thread.work, [&] {
      w.perform(DeliverNext{});
      const auto sent = w(PacketsSent{}) > 0;
      w.when(sent, [&] {
        const auto busy = w.feed(SendingThread{}, on<event_thread::CopySent>,
                                 {.now = w(Now{}), .send_time = w(SendingCost{})});
        w.when(busy.schedule, [&] { w.at(busy.next_at, SendingDue{}); });
      });
      w.when(!sent, [&] { w.feed(SendingThread{}, on<event_thread::NothingLeft>); });
    });
  }
};
/// Before a reader is sent a change for the first time it is told what it does not need before it.
struct ChangesAreSkipped : Rule<Happens<Skipped>> {
  template <class W>
  static void run(W& w) {
    w.emit(Gap{}, says(Says{CarriesHeartbeat{}, typename W::Bool(true)}));
  }
};
struct ChangeIsServed : Rule<Happens<Served>> {
  template <class W>
  static void run(W& w) {
    request<RelaySuppression, RelaySuppressionDuration, RelaySuppressionEnd>(w);
    w.emit(RelayedData{}, says(Says{CarriesHeartbeat{}, typename W::Bool(true)}));
  }
};
struct ChangeIsDelivered : Rule<Happens<Delivered>> {
  template <class W>
  static void run(W& w) {
    arm(w);
  }
};

struct RelayedAckNackArrives : Rule<Received<RelayedAckNack>> {
  template <class W>
  static void run(W& w) {
    const auto open = w(RelayOpen{});
    w.when(open && w(IsInitial{}), [&] {
      relay_heartbeat(w);
      arm(w);
    });
    w.when(open && !w(IsInitial{}), [&] {
      w.perform(TakeAckNack{});
      const auto requested = w(SomeRequested{});
      w.when(requested, [&] { request<RelayResponse, RelayResponseDelay, RelayResponseDue>(w); });
      w.when(!requested && w(SomeListed{}), [&] { arm(w); });
      w.when(w(SomeIrrelevant{}), [&] { w.emit(Gap{}, says()); });
    });
  }
};

struct RelayResponds : Rule<Due<RelayResponseDue>> {
  template <class W>
  static void run(W& w) {
    expire<RelayResponse>(w, [&] {
      w.perform(QueueAgain{});
      w.when(w(SomethingToSend{}), [&] { w.call(StartSending{}); });
    });
  }
};

struct RelaySuppressionEnds : Rule<Due<RelaySuppressionEnd>> {
  template <class W>
  static void run(W& w) {
    expire<RelaySuppression>(w, [&] {
      w.perform(EndSuppression{});
      arm(w);
    });
  }
};

struct RelayExpires : Rule<Due<RelayExpiryDue>> {
  template <class W>
  static void run(W& w) {
    expire<RelayExpiry>(w, [&] {
      const auto some = w.some_reader([](auto& r) { return r(LacksSomething{}); });
      w.for_readers([](auto& r) { r.when(r(LacksSomething{}), [&] { relay_heartbeat(r); }); });
      w.when(some, [&] { arm(w); });
    });
  }
};

/// What a server adds to Fast DDS. The rules of descriptors, of their writers and readers, and of
/// control-only relations are those of `fastdds::FastDds`.
struct FastDdsServer {
  static constexpr std::string_view name = "fastdds-server";
  using AckNack = RelayedAckNack;
  using Parts = TypeList<AnnouncementTimer, RegistrationExpiry, RegistrationReply,
                         RegistrationTimer, LearnerReply, LearnerTimer, Change, RelayExpiry,
                         RelayResponse, RelaySuppression, Routine, SendingThread>;
  using Timers =
      TypeList<ClientAnnouncement, ClientSync, RegistrationExpiryDue, RegistrationReplyDue,
               RegistrationAttempt, LearnerReplyDue, LearnerAttempt, RelayExpiryDue,
               RelayResponseDue, RelaySuppressionEnd, RoutineDue, RoutineAgain, SendingDue>;
  using State = TypeList<AnnouncementsSent, Recognised, RegistrationAcknowledged,
                         RegistrationHeartbeatSeen, RegistrationLastDelay, LearnerOpen,
                         LearnerHeartbeatSeen, LearnerLastDelay, RelayOpen>;
  using Packets = TypeList<Registration, RegistrationHeartbeat, RegistrationAckNack, RelayedData,
                           RelayHeartbeat, Gap, RelayedAckNack>;
  using Occasions = TypeList<Announces, Meets, RelayOpens, LearnerOpens, Arrives, Inserted, Skipped,
                             Served, Delivered>;
  using Announcing =
      TypeList<ClientAnnounces, AnnouncesToServer, ClientSyncIsDue, ServersMeet,
               RegistrationAckNackArrives, RegistrationExpires, RegistrationArrives,
               RegistrationHeartbeatArrives, RegistrationReplyIsDue, RegistrationInitialDue>;
  using Learning = Joined<TypeList<LearnerOpened, LearnerInitialDue, LearnerReplyIsDue>,
                          LearnerRules<HeedsAll>::Rules, TypeList<DescriptorsArrive>>;
  using Relaying = TypeList<RelayOpened, ChangeIsInserted, ThreadSends, ChangesAreSkipped,
                            ChangeIsServed, ChangeIsDelivered, RelayedAckNackArrives, RelayResponds,
                            RelaySuppressionEnds, RelayExpires>;
  using Rules = Joined<Announcing, Learning, RoutineRules<UpdateDatabase>::Rules, Relaying>;
  using IsOpen = RelayOpen;
  static constexpr std::array unused{
      Unused{"Change", "requested", "the step that feeds it answers SomeRequested"},
      Unused{"Change", "enqueue", "the step that feeds it fills the queue"},
      Unused{"Change", "Created", "the step that gives a change its number feeds it"},
      Unused{"Change", "InitialAckNackReceived", "an initial ACKNACK says nothing of changes"},
  };
  static constexpr std::array from_outside{
      FromOutside{"ClientAnnouncement", "announcement 0 is due when a participant starts"},
      FromOutside{"Arrives", "a reader of the server receives what is new"},
  };
};

}  // namespace stormproof::fsm::composition::server
