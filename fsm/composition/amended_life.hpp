// What the amended rules (fsm/composition/amended.hpp) lose of a side of a relation that is
// forgotten, and of a participant that comes back; the rest is in fsm/composition/life.hpp. And
// endpoints that are created and deleted in a run.
// Source: specs/guide/museum.md, "Participants that come and go".
#pragma once

#include "fsm/composition/amended_parts.hpp"
#include "fsm/composition/life.hpp"

namespace stormproof::fsm::composition::amended {

/// The reader side of a relation is a new one.
struct ForgetWriter : Procedure {
  template <class W>
  static void body(W& w) {
    w.renew(Reader{});
    w.renew(InitialTimer{});
    w.set_each(X{}, [](auto& d) { return !everyone(d); });
    w.set_each(Known{}, [](auto& d) { return d(Exists{}) && !d(WrittenLater{}); });
    w.set(HeartbeatSeen{}, typename W::Bool(false));
    w.set(LastHeard{}, typename W::Int(0));
    w.set(HasAsked{}, typename W::Bool(false));
    w.cancel(InitialAttempt{});
    w.cancel(AckNackGeneration{});
    w.cancel(ReaderRetryDue{});
  }
};
/// The writer side of a relation is a new one. The clock of its writer goes on for the others.
struct ForgetReader : Procedure {
  template <class W>
  static void body(W& w) {
    w.set(paper::WriterOpen{}, typename W::Bool(false));
    w.renew(C{});
    w.set(LastHeartbeat{}, typename W::Int(0));
    w.set(Required{}, typename W::Int(0));
    w.set(OldCounts{}, typename W::Int(0));
    w.set(HasAnswered{}, typename W::Bool(false));
    w.set(Contacted{}, typename W::Bool(false));
    w.set(Responded{}, typename W::Bool(false));
    w.set_each(Resent{}, [](auto& d) { return !everyone(d); });
    w.cancel(paper::RepairGeneration{});
    w.cancel(paper::SuppressionEnd{});
  }
};

struct LoseAll;
/// What it forgets.
struct Forgetting {
  using ForgetWriter = amended::ForgetWriter;
  using ForgetReader = amended::ForgetReader;
  using LoseAll = amended::LoseAll;
  template <class W>
  static void forget_peer(W& w) {
    w.cancel(CopyDue{});
  }
};
using Life = LifeRules<Forgetting>;

/// The participant is a new one in all that it has; others remember it as they did, and take some
/// of its ACKNACKs for those of its earlier life.
struct LoseAll : Opaque {
  template <class W>
  static void contract(W& w) {
    w.renew(AnnouncementTimer{});
    w.set(AnnouncementsSent{}, typename W::Int(0));
    w.cancel(Announcement{});
    w.for_known_peers([](auto& peer) {
      peer.reverse([](auto& back) { back.call(Life::Forget{}); });
      peer.for_streams([](auto& r) {
        r.renew(HeartbeatClock{});
        r.cancel(HeartbeatExpiry{});
        r.cancel(CycleStart{});
        r.cancel(CycleEnd{});
        r.cancel(BatchDue{});
        r.perform(RefillBudget{});
        r.reverse([](auto& q) {
          q.when(q(paper::WriterOpen{}), [&] { q.set(OldCounts{}, q(CountFilter{})); });
        });
      });
    });
  }
};

/// The application creates or deletes an endpoint.
struct Written : Occasion<owner::entry> {};

inline constexpr FromOutside endpoint_changes{"Written",
                                              "the application creates and deletes endpoints"};

}  // namespace stormproof::fsm::composition::amended
