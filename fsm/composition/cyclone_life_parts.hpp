// What there is in Cyclone DDS besides if its participants have a life: timers, state, packets, the
// facts that rules ask for, and the steps that are stated by their contracts only. The rules are in
// fsm/composition/cyclone_life.hpp.
#pragma once

#include "fsm/composition/cyclone_parts.hpp"
#include "fsm/composition/life.hpp"

namespace stormproof::fsm::composition::cyclone {

// The liveliness writer's, and that of addresses at which nobody is known (any more).
struct LivelinessTimer : Part<MovableTimer, owner::participant> {};
struct AddressTimer : Part<MovableTimer, owner::participant> {};
struct LivelinessTime : Timer<owner::participant> {};
struct AddressTime : Timer<owner::participant> {};
struct LivelinessDue : Number<owner::participant> {};
struct AddressDue : Number<owner::participant> {};

struct Gone : Flag<owner::entry> {};         ///< the writer has had the sample, and has it no more
struct Passed : Flag<owner::descriptor> {};  ///< the reader knows that, and never got the sample
struct IsMissed : Flag<owner::descriptor> {};  ///< the ACKNACK that is looked at asks for it
struct OpenedAt : Number<owner::relation> {};  ///< the reader side, ns

struct AnnouncingPeriod : Amount {};    ///< between two announcements of the participant, ns
struct LivelinessPeriod : Amount {};    ///< between two samples of its liveliness writer, ns
struct RepliesDue : Amount {};          ///< directed ones to somebody who is recognised
struct PreEmptiveInterval : Amount {};  ///< by the age of the reader side, ns
struct NextAddress : Amount {};         ///< when the next address is due, ns; 0: none is
/// A HEARTBEAT rides on a sample unless the one before is more recent than that.
struct PiggybackDelay : FixedDelay<80'000'000> {};

/// An announcement says that its participant is gone.
struct IsGoodbye : PacketField {};
/// A HEARTBEAT says that these exist no more.
struct BelowFirst : DescriptorField {};
/// A GAP says that these exist no more.
struct Lists : DescriptorField {};
struct Gap : Packet<owner::relation, Lists> {};

struct PacketBegins : Occasion<owner::pair> {};
struct ReaderCloses : Occasion<owner::relation> {};
struct WriterCloses : Occasion<owner::relation> {};
struct Deleted : Occasion<owner::entry> {};  ///< an endpoint; the sample is the one that says so
struct Leaves : Occasion<owner::participant> {};
struct LivelinessWritten : Occasion<owner::entry> {};
struct LivelinessTimerFires : Occasion<owner::participant> {};
struct AddressTimerFires : Occasion<owner::participant> {};

/// The reader's timer leaves the list of what its participant's thread has to do.
struct LeaveList : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// Samples that say that an endpoint is deleted exist until all readers have acknowledged them.
struct DropAcknowledged : Opaque {
  template <class W>
  static void contract(W& w) {
    w.set_each(Gone{}, [](auto& d) {
      return d(Gone{}) || (d(Exists{}) && d.choice("it is about a deletion that all readers have"));
    });
  }
};
/// Sides of user topics close: all between two participants,
struct CloseAllTopics : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("a reader side is open"), [&] { w.raise(ReaderCloses{}); });
    w.when(w.choice("a writer side is open"), [&] { w.raise(WriterCloses{}); });
  }
};
/// or those of the endpoint that is deleted; and the sample of its creation exists no more.
struct CloseTopics : Opaque {
  template <class W>
  static void contract(W& w) {
    w.set_each(Gone{}, [](auto& d) { return d(Gone{}) || d.choice("it is about its creation"); });
    w.when(w.choice("a reader side is open"), [&] { w.raise(ReaderCloses{}); });
    w.when(w.choice("a writer side is open"), [&] { w.raise(WriterCloses{}); });
  }
};
/// The reader has been notified of an endpoint, or of its deletion: sides of its topic open or
/// close.
struct FollowEndpoint : Opaque {
  template <class W>
  static void contract(W& w) {
    w.perform(OpenTopics{});
    w.when(w.choice("its deletion closes a reader side"), [&] { w.raise(ReaderCloses{}); });
    w.when(w.choice("its deletion closes a writer side"), [&] { w.raise(WriterCloses{}); });
  }
};

/// The thread also fires the timers of liveliness and of addresses.
struct LivingWork : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("its liveliness timer is on the list"),
           [&] { w.raise(LivelinessTimerFires{}); });
    w.when(w.choice("its address timer is on the list"), [&] { w.raise(AddressTimerFires{}); });
    w.perform(Work{});
  }
};

// Addresses of announcements. What becomes of that of the pair's source at its destination:
/// it is announced to,
struct KeepAddress : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// it is announced to rarely, and some day no more,
struct LetAddressAge : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// it is announced to no more, unless it is a peer's.
struct DropAddress : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// The first announcement goes to all addresses, also to those where nobody is known.
struct AnnounceEverywhere : Opaque {
  template <class W>
  static void contract(W& w) {
    w.perform(Announce{});
  }
};
/// So does the last one, which says that the participant is gone.
struct SayGoodbye : Opaque {
  template <class W>
  static void contract(W& w) {
    w.emit(Spdp{}, says(Says{IsGoodbye{}, typename W::Bool(true)}));
  }
};
/// Of the addresses that are due those whose time is over are dropped, the others announced to.
struct AgeAddresses : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("one is due"), [&] { w.perform(Announce{}); });
  }
};
/// What a participant that leaves has to do is nothing, but for its queue.
struct LoseTimers : Opaque {
  template <class W>
  static void contract(W&) {}
};

/// The next sample of the liveliness writer comes into being.
struct WriteLiveliness : Opaque {
  template <class W>
  static void contract(W& w) {
    w.raise(LivelinessWritten{});
  }
};
/// It joins the packet that is open.
struct SayLiveliness : Opaque {
  template <class W>
  static void contract(W& w) {
    w.perform(DataToAll{});
  }
};
/// The packet that is open is sent, whatever else there is to do.
struct CompletePacket : Opaque {
  template <class W>
  static void contract(W&) {}
};

}  // namespace stormproof::fsm::composition::cyclone
