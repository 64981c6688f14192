// SPDP: the announcement schedule of a participant, what it sends, and what it does when it hears
// of another one for the first time. `C` is the implementation; it says
//   C::open_sides(w)   which sides of which relations open when the pair's destination has
//                      recognised its source
//   C::multicast_first whether an announcement goes to the group before its unicast copies
// Source: specs/guide/model.md, "SPDP".
#pragma once

#include "fsm/announcer.hpp"
#include "fsm/composition/packets.hpp"
#include "fsm/composition/vocabulary.hpp"

namespace stormproof::fsm::composition {

struct AnnouncementTimer : Part<Announcer, owner::participant> {};

struct Announcement : Timer<owner::participant> {};

struct AnnouncementsSent : Number<owner::participant> {};
/// The destination of the pair has recognised its source.
struct Recognised : Flag<owner::pair> {};

/// How many follow announcement 0.
struct StartupAnnouncements : DelayOf<"spdp.startup_announcements"> {};
struct StartupPeriod : DelayOf<"spdp.startup_period"> {};
struct AnnouncementPeriod : DelayOf<"spdp.period"> {};  ///< τ_P
// What is sent to a participant that is recognised; none of them: nothing.
struct ResendsToAll : SwitchOf<"spdp.resend", "all_known"> {};
struct ResendsCopyAndMulticast : SwitchOf<"spdp.resend", "new_and_multicast"> {};
struct ResendsCopy : SwitchOf<"spdp.resend", "new_only"> {};

/// To every started participant of another host, each of which is a pair with the source. Fast
/// DDS's also reaches those of the same host.
struct SpdpMulticast : Packet<owner::pair> {};
struct SpdpUnicast : Packet<owner::pair> {};

inline constexpr FromOutside announcements_start{"Announcement",
                                                 "announcement 0 is due when a participant starts"};
/// A unicast copy to each participant that is known. A host may keep the copies as one record.
struct CopyToKnown : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_known_peers([](auto& peer) { peer.emit(SpdpUnicast{}, says()); });
  }
};

/// What the timer of announcements looks at when one is due.
template <class W>
AnnouncerIo::Input<typename W::D> announcer_input(W& w) {
  return {.now = w(Now{}),
          .number = w(AnnouncementsSent{}),
          .startup = w(StartupAnnouncements{}),
          .startup_period = w(StartupPeriod{}),
          .period = w(AnnouncementPeriod{})};
}

template <class C>
struct AnnouncementRules {
  struct AnnouncementIsDue : Rule<Due<Announcement>> {
    template <class W>
    static void run(W& w) {
      const auto timer =
          w.feed(AnnouncementTimer{}, on<announcer::AnnouncementDue>, announcer_input(w));
      w.set(AnnouncementsSent{}, w(AnnouncementsSent{}) + 1);
      w.when(timer.announce, [&] {
        announce(w, [&] { w.perform(CopyToKnown{}); });
        w.at(timer.next_at, Announcement{});
      });
    }
  };

  struct MulticastArrives : Rule<Received<SpdpMulticast>> {
    template <class W>
    static void run(W& w) {
      w.call(Hear{});
    }
  };
  struct UnicastArrives : Rule<Received<SpdpUnicast>> {
    template <class W>
    static void run(W& w) {
      w.call(Hear{});
    }
  };

  using Rules = TypeList<AnnouncementIsDue, MulticastArrives, UnicastArrives>;

 private:
  template <class W, class Copies>
  static void announce(W& w, Copies&& copies) {
    if constexpr (C::multicast_first) w.emit(SpdpMulticast{}, says());
    copies();
    if constexpr (!C::multicast_first) w.emit(SpdpMulticast{}, says());
  }

  /// `w` is the pair of the one who announced itself and the one who hears it.
  struct Hear : Procedure {
    template <class W>
    static void body(W& w) {
      w.when(!w(Recognised{}), [&] {
        w.set(Recognised{}, typename W::Bool(true));
        w.reverse([](auto& back) { answer(back); });
        C::open_sides(w);
      });
    }
  };
  template <class W>
  static void answer(W& back) {
    back.when(back(ResendsToAll{}), [&] { announce(back, [&] { back.perform(CopyToKnown{}); }); });
    back.when(back(ResendsCopyAndMulticast{}),
              [&] { announce(back, [&] { back.emit(SpdpUnicast{}, says()); }); });
    back.when(back(ResendsCopy{}), [&] { back.emit(SpdpUnicast{}, says()); });
  }
};

}  // namespace stormproof::fsm::composition
