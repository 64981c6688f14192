// Participants that forget each other, and that come back having lost what they knew: part of the
// amended composition (fsm/composition/amended.hpp). A side of a relation that was forgotten is a
// new one: its machines are, it remembers nothing, and what was due for the old one is due no more.
// Source: specs/guide/museum.md, "Participants that come and go".
#pragma once

#include "fsm/composition/amended_parts.hpp"

namespace stormproof::fsm::composition::amended {

/// Anything of the pair's source has reached its destination.
struct HearFrom : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(w(Recognised{}) && w(LeaseDuration{}) > 0, [&] {
      w.set(ForgottenAt{}, w(Now{}) + w(LeaseDuration{}));
      w.when(!w(LeaseRuns{}), [&] {
        w.set(LeaseRuns{}, typename W::Bool(true));
        w.at(w(ForgottenAt{}), LeaseCheck{});
      });
    });
  }
};

/// The reader side of a relation is a new one.
struct ForgetWriter : Procedure {
  template <class W>
  static void body(W& w) {
    w.renew(Reader{});
    w.renew(InitialTimer{});
    w.set_each(X{}, [](auto& d) { return !everyone(d); });
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

/// The pair's destination forgets its source, as reader and as writer.
struct Forget : Procedure {
  template <class W>
  static void body(W& w) {
    w.set(Recognised{}, typename W::Bool(false));
    w.set(LeaseRuns{}, typename W::Bool(false));
    w.cancel(LeaseCheck{});
    w.for_streams([](auto& r) { r.call(ForgetWriter{}); });
    w.reverse([](auto& back) {
      back.cancel(CopyDue{});
      back.for_streams([](auto& r) { r.call(ForgetReader{}); });
    });
  }
};

struct LeaseIsChecked : Rule<Due<LeaseCheck>> {
  template <class W>
  static void run(W& w) {
    const auto heard = w(ForgottenAt{}) > w(Now{});
    w.when(heard, [&] { w.at(w(ForgottenAt{}), LeaseCheck{}); });
    w.when(!heard, [&] { w.call(Forget{}); });
  }
};

/// The participant is a new one in all that it has; others remember it as they did, and take some
/// of its ACKNACKs for those of its earlier life.
struct LoseAll : Opaque {
  template <class W>
  static void contract(W& w) {
    w.renew(AnnouncementTimer{});
    w.set(AnnouncementsSent{}, typename W::Int(0));
    w.cancel(Announcement{});
    w.for_known_peers([](auto& peer) {
      peer.reverse([](auto& back) { back.call(Forget{}); });
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
struct Returns : Rule<Due<Return>> {
  template <class W>
  static void run(W& w) {
    w.perform(LoseAll{});
    w.at(w(Now{}), Announcement{});
  }
};

inline constexpr FromOutside participant_returns{"Return",
                                                 "a participant is there again when the deployment "
                                                 "says so; its first announcement 0 is due when "
                                                 "it starts"};

}  // namespace stormproof::fsm::composition::amended
