// What there is in Fast DDS besides what all implementations share: parts and who has one, state,
// packets, the facts that rules ask for, and the steps that are stated by their contracts only. The
// rules are in fsm/composition/fastdds.hpp.
#pragma once

#include "fsm/change_for_reader.hpp"
#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/packets.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::fsm::composition::fastdds {

using composition::CrossHost;

/// The writer's view of a descriptor, in the paper's letters.
struct C : Part<ChangeForReader, owner::descriptor> {};
struct Reply : Part<SingleShot, owner::relation> {};
struct Suppression : Part<SingleShot, owner::relation> {};
struct NackResponse : Part<SingleShot, owner::writer> {};
struct AsyncRun : Part<SingleShot, owner::participant> {};

struct SuppressionEnd : Timer<owner::relation> {};
struct NackResponseDue : Timer<owner::writer> {};
struct AsyncRunDue : Timer<owner::participant> {};

struct WriterOpen : Flag<owner::relation> {};  ///< the reader is matched
/// Created, that is among the first H of the writer.
struct Exists : Flag<owner::entry> {};
/// In the participant's asynchronous queue, which is first in, first out.
struct Enqueued : Flag<owner::entry> {};
/// The low mark is above 0: an ACKNACK has acknowledged something for good.
struct SomeConfirmed : Flag<owner::relation> {};
struct Known : Flag<owner::descriptor> {};  ///< the reader knows that it exists
/// The reader's participant has taken it from the reader, in order.
struct HandedOver : Flag<owner::descriptor> {};
/// It does not know the type yet (fsm/composition/lookups.hpp).
struct WaitsForType : Flag<owner::descriptor> {};
/// The reader's application knows.
struct Notified : Fact {
  template <class W>
  static auto of(W& w) {
    return w(HandedOver{}) && !w(WaitsForType{});
  }
};

struct NackResponseDelay : DelayOf<"sedp.nack_response_delay"> {};          ///< τ_N
struct SuppressionDuration : DelayOf<"sedp.nack_suppression_duration"> {};  ///< τ_S

struct OpensBuiltinFirst : SwitchOf<"match_order", "builtin_first">, OfDestination {};

struct Data : Packet<owner::relation, Carries, Announces, CarriesHeartbeat> {};
struct Heartbeat : Packet<owner::relation, Announces> {};
struct AckNack : Packet<owner::relation, Listed, BelowBase, IsInitial> {};

struct WriterOpens : Occasion<owner::relation> {};
struct Created : Occasion<owner::entry> {};

/// The writer has readers.
struct HasReaders : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto&) { return typename W::Bool(true); });
  }
};
/// Some descriptor of the writer exists.
struct HasDescriptors : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some([](auto& d) { return d(Exists{}); });
  }
};
/// As the adaptive policy sees it: something that exists is not in A.
struct Waits : Fact {
  template <class W>
  static auto of(W& w) {
    return (w(HasDescriptors{}) && !w(SomeConfirmed{})) ||
           w.some([](auto& d) { return d(Exists{}) && !d.in(C{}, is<change_for_reader::A>); });
  }
};
/// As the periodic policy sees it: something is in U.
struct WaitsForExpiry : Fact {
  template <class W>
  static auto of(W& w) {
    return (w(HasDescriptors{}) && !w(SomeConfirmed{})) ||
           w.some([](auto& d) { return d.in(C{}, is<change_for_reader::U>); });
  }
};
struct NeedsHeartbeat : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto& r) {
      return (r(Adaptive{}) && r(Waits{})) || (!r(Adaptive{}) && r(WaitsForExpiry{}));
    });
  }
};
struct QueueNotEmpty : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_entry([](auto& e) { return e(Enqueued{}); });
  }
};

template <class W>
void emit_heartbeat(W& w) {
  w.emit(Heartbeat{}, says(Says{Announces{}, [](auto& d) { return d(Exists{}); }}));
}

/// One message to every reader, which names its reader only if there is a single one.
struct HeartbeatToAll : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_readers([](auto& r) { emit_heartbeat(r); });
  }
};
/// What is requested joins the queue, ascending, unless it is in it.
struct Enqueue : Opaque {
  template <class W>
  static void contract(W& w, const typename W::Set& set) {
    w.set_each(Enqueued{}, [&](auto& d) { return d(Enqueued{}) || d.is_in(set); });
  }
};
/// The one who is served by a descriptor that is sent: at creation every reader of the writer, from
/// the queue those for which it is in Q.
struct ToAll {
  static constexpr bool repairs = false;
  template <class R>
  static auto serves(R&) {
    return typename R::Bool(true);
  }
};
struct ToRequesters {
  static constexpr bool repairs = true;
  template <class R>
  static auto serves(R& r) {
    return r.in(C{}, is<change_for_reader::Q>);
  }
};
/// The descriptor joins the message that is open, if that goes to the same readers, has room and
/// does not carry it yet; otherwise that is flushed, and another one opened. What a message says is
/// stated when it joins, as if it went alone: to a descriptor, a packet that carries others as well
/// is one that carries it.
struct Pack : Opaque {
  using FillsMessage = void;

  template <class W, class To>
  static void contract(W& w, To) {
    const auto rides = w.choice("a HEARTBEAT rides in it");
    w.for_readers([&](auto& r) {
      r.when(To::serves(r), [&] {
        r.emit(Data{}, says(Says{Carries{}, [](auto& d) { return d.is_subject(); }},
                            Says{IsRepair{}, typename W::Bool(To::repairs)},
                            Says{Announces{}, [](auto& d) { return d(Exists{}); }},
                            Says{CarriesHeartbeat{}, rides}));
      });
    });
  }
};
/// The descriptor is charged against the piggyback budget of its writer; if that is used up, a
/// HEARTBEAT to every reader joins the open message, which is flushed first if it goes to others.
struct Charge : Opaque {
  using FillsMessage = void;

  template <class W, class To>
  static void contract(W& w, To) {
    w.when(w.choice("the budget is used up"),
           [&] { w.for_readers([](auto& r) { emit_heartbeat(r); }); });
  }
};
/// The open message is emitted, one packet for each of its readers.
struct Flush : Opaque {
  using SendsMessage = void;

  template <class W, class To>
  static void contract(W&, To) {}
};

}  // namespace stormproof::fsm::composition::fastdds
