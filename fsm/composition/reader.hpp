// The reader side of a relation, which all implementations share: announcements open it, DATA fills
// its bitmap X, HEARTBEATs make it answer, and as long as it has seen none it asks by itself. `C`
// is the implementation; it says
//   C::learn_from_data(w), C::learn_from_heartbeat(w)   what it notes besides X
//   C::answer_later(w)                                  how an ACKNACK is scheduled
//   C::acknack_due(w, body)                             and what happens when it is due
//   C::emit_acknack(w), C::emit_initial(w)
// Sources: specs/guide/model.md, "Reception of SEDP packets"; specs/guide/fastdds.md, "Reader".
#pragma once

#include "fsm/composition/packets.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/initial_acknack.hpp"

namespace stormproof::fsm::composition {

struct Reader : Part<DiscoveryReader, owner::relation> {};
struct InitialTimer : Part<InitialAckNack, owner::relation> {};

struct InitialAttempt : TimerAtDestination<owner::relation> {};
struct AckNackGeneration : TimerAtDestination<owner::relation> {};

struct X : Flag<owner::descriptor> {};  ///< the reader has the descriptor
struct HeartbeatSeen : Flag<owner::relation> {};
/// The delay of the initial ACKNACK that is running, ns. A host may stop doubling it once it is
/// longer than any run.
struct LastDelay : Number<owner::relation> {};

/// What a reader side that is not open does with DATA and HEARTBEATs.
struct AcceptsUnmatched : Switch,
                          OfDestination {};  ///< also if both sides open at once: of two knobs
/// τ_I; 0 disables initial ACKNACKs.
struct InitialDelay : DelayOf<"sedp.initial_acknack_delay">, OfDestination {};
/// The delay does not double.
struct ConstantInterval : SwitchOf<"sedp.initial_acknack_interval", "constant">, OfDestination {};
struct ResponseDelay : DelayOf<"sedp.heartbeat_response_delay">, OfDestination {};  ///< τ_A
struct RunEnds : Answer {};  ///< discovery is complete, and the run ends with that

struct ReaderOpens : Occasion<owner::relation> {};

/// What an ACKNACK can say of a descriptor.
inline constexpr auto is_missing = [](auto& d) { return !d(X{}); };
inline constexpr auto is_confirmed = [](auto& d) {
  return d.all_up_to([](auto& e) { return e(X{}); });
};

/// How many descriptors the reader lacks.
struct Missing : Fact {
  template <class W>
  static auto of(W& w) {
    return w.count(is_missing);
  }
};

/// The initial ACKNACK timer of any kind of relation.
template <class TimerPart, class Seen, class Last, class Attempt>
struct InitialAttempts {
  template <class W>
  static void open(W& w) {
    wait(w, w.feed(TimerPart{}, on<initial_acknack::ReaderOpened>, input(w)));
  }
  template <class W, class Send>
  static void attempt(W& w, Send&& send) {
    const auto timer = w.feed(TimerPart{}, on<initial_acknack::AttemptDue>, input(w));
    w.when(timer.attempt, send);
    wait(w, timer);
  }

 private:
  template <class W>
  static InitialAckNackIo::Input<typename W::D> input(W& w) {
    return {.now = w(Now{}),
            .first_delay = w(InitialDelay{}),
            .last_delay = w(Last{}),
            .heartbeat_seen = w(Seen{}),
            .constant = w(ConstantInterval{})};
  }
  template <class W, class Outbox>
  static void wait(W& w, const Outbox& timer) {
    w.when(timer.schedule, [&] {
      w.set(Last{}, timer.next_delay);
      w.at(timer.next_at, Attempt{});
    });
  }
};

/// A reader that notes nothing besides X, answers each HEARTBEAT by itself, and asks for all that
/// it lacks.
struct AnswersEachHeartbeat {
  template <class W>
  static void learn_from_data(W&) {}
  template <class W>
  static void learn_from_heartbeat(W&) {}
  template <class W>
  static void answer_later(W& w) {
    w.after(ResponseDelay{}, AckNackGeneration{});
  }
  template <class W, class Body>
  static void acknack_due(W&, Body&& body) {
    body();
  }
  /// The bitmap of the instant at which it is emitted; it never changes after.
  static auto bitmap() { return says(Says{Listed{}, is_missing}, Says{BelowBase{}, is_confirmed}); }
};

template <class C>
struct ReaderRules {
  struct ReaderOpened : Rule<Happens<ReaderOpens>> {
    template <class W>
    static void run(W& w) {
      const auto reader = ask<discovery_reader::AnnouncementReceived>(w);
      w.when(reader.opened, [&] { Attempts::open(w); });
    }
  };

  struct InitialAckNackDue : Rule<Due<InitialAttempt>> {
    template <class W>
    static void run(W& w) {
      Attempts::attempt(w, [&] {
        const auto reader = ask<discovery_reader::InitialAckNackDue>(w);
        w.when(reader.send_initial, [&] { C::emit_initial(w); });
      });
    }
  };

  struct DataArrives : Rule<Received<typename C::Data>> {
    template <class W>
    static void run(W& w) {
      const auto missing_after = w.count([](auto& d) { return !d(X{}) && !d(Carries{}); });
      const auto reader =
          w.feed(Reader{}, on<discovery_reader::DataReceived>, input(w, missing_after));
      w.when(reader.take_data, [&] {
        w.set_each(X{}, [](auto& d) { return d(X{}) || d(Carries{}); });
        C::learn_from_data(w);
      });
      w.when(w(CarriesHeartbeat{}) && !w(RunEnds{}), [&] { w.call(TakeHeartbeat{}); });
    }
  };

  struct HeartbeatArrives : Rule<Received<typename C::Heartbeat>> {
    template <class W>
    static void run(W& w) {
      w.call(TakeHeartbeat{});
    }
  };

  struct AckNackDue : Rule<Due<AckNackGeneration>> {
    template <class W>
    static void run(W& w) {
      C::acknack_due(w, [&] {
        const auto reader = ask<discovery_reader::AckNackDue>(w);
        w.when(reader.send_acknack, [&] { C::emit_acknack(w); });
      });
    }
  };

  using Rules =
      TypeList<ReaderOpened, InitialAckNackDue, DataArrives, HeartbeatArrives, AckNackDue>;

 private:
  using Attempts = InitialAttempts<InitialTimer, HeartbeatSeen, LastDelay, InitialAttempt>;

  template <class W>
  static DiscoveryReaderIo::Input<typename W::D> input(W& w, const typename W::Int& missing) {
    return {.accepts_unmatched = w(AcceptsUnmatched{}), .missing_after = missing};
  }
  template <class Event, class W>
  static auto ask(W& w) {
    return w.feed(Reader{}, on<Event>, input(w, w(Missing{})));
  }

  struct TakeHeartbeat : Procedure {
    template <class W>
    static void body(W& w) {
      const auto reader = ask<discovery_reader::HeartbeatReceived>(w);
      w.when(reader.schedule_acknack, [&] {
        w.set(HeartbeatSeen{}, typename W::Bool(true));
        C::learn_from_heartbeat(w);
        C::answer_later(w);
      });
    }
  };
};

}  // namespace stormproof::fsm::composition
