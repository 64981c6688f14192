// Participants that forget each other, and that come back having lost what they knew: what is alike
// under the rules of every implementation that has a life. A side of a relation that was forgotten
// is a new one: its machines are, it remembers nothing, and what was due for the old one is due no
// more. `C` is the implementation; it says what it calls what every implementation has,
//   C::Descriptor, C::WriterOpen, C::SuppressionEnd
// and what it has besides that is new then,
//   C::forget_writer(w)     of the reader side of a relation
//   C::forget_reader(w)     of its writer side
//   C::forget_peer(w)       of what the pair's source has for its destination
//   C::lose_participant(w)  of a participant
//   C::lose_writer(w)       of one of its writers, seen from a relation of it
// Source: specs/guide/museum.md, "Participants that come and go".
#pragma once

#include "fsm/composition/announcements.hpp"
#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"

namespace stormproof::fsm::composition {

/// Whether the pair's destination has heard of its source within the lease.
struct LeaseCheck : TimerAtDestination<owner::pair> {};
/// The participant is there again.
struct Return : Timer<owner::participant> {};

struct LeaseDuration : Amount {};  ///< of the source of the pair; 0: it is never forgotten
struct ForgottenAt : Number<owner::pair> {};  ///< when the lease ends, unless it is renewed
struct LeaseRuns : Flag<owner::pair> {};

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

template <class C>
struct LifeRules {
  /// The reader side of a relation is a new one.
  struct ForgetWriter : Procedure {
    template <class W>
    static void body(W& w) {
      w.renew(Reader{});
      w.renew(InitialTimer{});
      w.set_each(X{}, [](auto& d) { return !everyone(d); });
      w.set(HeartbeatSeen{}, typename W::Bool(false));
      w.cancel(InitialAttempt{});
      w.cancel(AckNackGeneration{});
      C::forget_writer(w);
    }
  };
  /// The writer side of a relation is a new one. What its writer and its participant have to do
  /// goes on for the others: the clock of HEARTBEATs above all.
  struct ForgetReader : Procedure {
    template <class W>
    static void body(W& w) {
      w.set(typename C::WriterOpen{}, typename W::Bool(false));
      w.renew(typename C::Descriptor{});
      w.set(Contacted{}, typename W::Bool(false));
      w.set(Responded{}, typename W::Bool(false));
      w.cancel(typename C::SuppressionEnd{});
      C::forget_reader(w);
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
        C::forget_peer(back);
        back.for_streams([](auto& r) { r.call(ForgetReader{}); });
      });
    }
  };

  /// What a participant has beside its peers is new.
  template <class W>
  static void lose_participant(W& w) {
    w.renew(AnnouncementTimer{});
    w.set(AnnouncementsSent{}, typename W::Int(0));
    w.cancel(Announcement{});
    C::lose_participant(w);
  }
  /// What one of its writers has beside its readers is new.
  template <class W>
  static void lose_writer(W& w) {
    w.renew(HeartbeatClock{});
    w.cancel(HeartbeatExpiry{});
    w.cancel(CycleStart{});
    w.cancel(CycleEnd{});
    w.cancel(BatchDue{});
    w.perform(RefillBudget{});
    C::lose_writer(w);
  }
  /// The participant is a new one in all that it has; others remember it as they did. A host
  /// forgets all peers, whether it knows them or not, before it comes to the writers.
  struct LoseAll : Opaque {
    using LosesAll = LifeRules;

    template <class W>
    static void contract(W& w) {
      lose_participant(w);
      w.for_known_peers([](auto& peer) {
        peer.reverse([](auto& back) { back.call(Forget{}); });
        peer.for_streams([](auto& r) { lose_writer(r); });
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

  struct Returns : Rule<Due<Return>> {
    template <class W>
    static void run(W& w) {
      w.perform(LoseAll{});
      w.at(w(Now{}), Announcement{});
    }
  };

  using Rules = TypeList<LeaseIsChecked, Returns>;
};

inline constexpr FromOutside participant_returns{"Return",
                                                 "a participant is there again when the deployment "
                                                 "says so; its first announcement 0 is due when "
                                                 "it starts"};

}  // namespace stormproof::fsm::composition
