// Participants that forget each other, and that come back having lost what they knew: what is alike
// under the rules of every implementation that has a life. A side of a relation that was forgotten
// is a new one: its machines are, it remembers nothing, and what was due for the old one is due no
// more. `C` is the implementation; it says
//   C::ForgetWriter, C::ForgetReader  the reader and the writer side of a relation is a new one
//   C::forget_peer(w)                 what else the pair's source has for its destination
//   C::LoseAll                        a participant is a new one in all that it has
// Source: specs/guide/museum.md, "Participants that come and go".
#pragma once

#include "fsm/composition/announcements.hpp"

namespace stormproof::fsm::composition {

/// Whether the pair's destination has heard of its source within the lease.
struct LeaseCheck : Timer<owner::pair> {};
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
  /// The pair's destination forgets its source, as reader and as writer.
  struct Forget : Procedure {
    template <class W>
    static void body(W& w) {
      w.set(Recognised{}, typename W::Bool(false));
      w.set(LeaseRuns{}, typename W::Bool(false));
      w.cancel(LeaseCheck{});
      w.for_streams([](auto& r) { r.call(typename C::ForgetWriter{}); });
      w.reverse([](auto& back) {
        C::forget_peer(back);
        back.for_streams([](auto& r) { r.call(typename C::ForgetReader{}); });
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
      w.perform(typename C::LoseAll{});
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
