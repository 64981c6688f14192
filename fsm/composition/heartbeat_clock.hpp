// The HEARTBEAT timer of a writer and what it asks for, under both policies. `C` is the
// implementation; it says
//   C::Waits            fact of a relation: its reader has not acknowledged everything
//   C::NeedsHeartbeat   fact of a writer: an expiry or a cycle has a reason to send
//   C::Exists           flag or fact of a descriptor of the writer: HEARTBEATs announce it
//   C::heartbeat(w)     sends one to the reader of a relation
//   C::periodic(w)      sends what an expiry of the periodic policy sends
// Sources: specs/guide/model.md, "Periodic HEARTBEAT" and "Response-aware HEARTBEAT policy".
#pragma once

#include "fsm/composition/packets.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/heartbeat_timer.hpp"

namespace stormproof::fsm::composition {

struct HeartbeatClock : Part<HeartbeatTimer, owner::writer> {};

struct HeartbeatExpiry : Timer<owner::writer, true> {};
struct CycleStart : Timer<owner::writer, true> {};
struct CycleEnd : Timer<owner::writer, true> {};
struct BatchDue : Timer<owner::writer, true> {};

struct HeartbeatPeriod : DelayOf<"sedp.heartbeat_period"> {};  ///< τ_H
struct Additive : SwitchOf<"sedp.heartbeat_timer", "additive"> {};
struct Adaptive : SwitchOf<"sedp.heartbeat_policy", "adaptive"> {};

// The cycle of the adaptive policy.
struct CycleBegan : Number<owner::writer> {};   ///< c, ns
struct CyclePeriod : Number<owner::writer> {};  ///< T, ns
struct Contacted : Flag<owner::relation> {};    ///< the cycle has asked this reader
struct Responded : Flag<owner::relation> {};    ///< it has answered
struct AnnouncedAtStart : Flag<owner::entry> {};
struct ContactedCount : Amount {};  ///< H, readers of the writer that the cycle has contacted
struct RespondedCount : Amount {};  ///< A, those of them that have responded
struct MinPeriod : DelayOf<"sedp.adaptive.min_period"> {};
struct MaxPeriod : DelayOf<"sedp.adaptive.max_period"> {};
struct EpsilonNumerator : Delay {};
struct EpsilonDenominator : Delay {};

/// The piggyback budget of the writer is full again: every HEARTBEAT that it sends fills it.
struct RefillBudget : Opaque {
  template <class W>
  static void contract(W&) {}
};
/// The silent readers of the cycle form batches of `batch_size` (fsm/adaptive_period.hpp); with m
/// of them, batch k is due at now + (period - T)·k/m.
struct PlanBatches : Opaque {
  template <class W>
  static void contract(W& w, const typename W::Int& period) {
    w.when(w.choice("some readers are silent"), [&] { w.at(w(Now{}) + period, BatchDue{}); });
  }
};
template <class C>
struct ClockRules {
  /// A HEARTBEAT to each reader of the next batch that still waits.
  struct SendBatch : Opaque {
    using SendsBatch = C;

    template <class W>
    static void contract(W& w) {
      w.for_readers_by_number([](auto& r) {
        r.when(r.choice("in this batch") && r(typename C::Waits{}), [&] { C::heartbeat(r); });
      });
    }
  };

  /// Something must be checked after τ_H: arms the timer if it is idle.
  template <class W>
  static void arm(W& w) {
    request<heartbeat_timer::ArmRequested>(w);
  }
  /// A suppression has ended with something unacknowledged.
  template <class W>
  static void suppression_ended(W& w) {
    request<heartbeat_timer::SuppressionEnded>(w);
  }
  /// A clean ACKNACK of this relation's reader arrives. It counts once for the cycle that contacted
  /// the reader, if the reader has all that was announced when the cycle started.
  template <class W>
  static void response(W& w) {
    w.when(w(Adaptive{}) && w(Contacted{}) && !w(Responded{}), [&] {
      const auto up_to_date =
          w.all([](auto& d) { return d(BelowBase{}) || !d(AnnouncedAtStart{}); });
      w.when(up_to_date, [&] {
        const auto clock = feed<heartbeat_timer::ResponseReceived>(w);
        w.when(clock.count_response, [&] { w.set(Responded{}, typename W::Bool(true)); });
        w.call(CycleGoesOn{}, clock);
      });
    });
  }

  struct HeartbeatExpires : Rule<Due<HeartbeatExpiry>> {
    template <class W>
    static void run(W& w) {
      step<heartbeat_timer::Expired>(w);
    }
  };
  struct CycleStarts : Rule<Due<CycleStart>> {
    template <class W>
    static void run(W& w) {
      w.for_readers([](auto& r) { r.set(Contacted{}, typename W::Bool(false)); });
      step<heartbeat_timer::CycleStarted>(w);
    }
  };
  struct CycleEnds : Rule<Due<CycleEnd>> {
    template <class W>
    static void run(W& w) {
      step<heartbeat_timer::CycleEnded>(w);
    }
  };
  struct BatchIsDue : Rule<Due<BatchDue>> {
    template <class W>
    static void run(W& w) {
      step<heartbeat_timer::BatchDue>(w);
    }
  };

  using Rules = TypeList<HeartbeatExpires, CycleStarts, CycleEnds, BatchIsDue>;

 protected:
  /// A cycle starts: it asks every reader that has not acknowledged everything.
  template <class W>
  static void contact(W& w) {
    w.set(CycleBegan{}, w(Now{}));
    w.set_each(AnnouncedAtStart{}, [](auto& d) { return d(typename C::Exists{}); });
    w.for_readers([](auto& r) {
      r.set(Responded{}, typename W::Bool(false));
      r.set(Contacted{}, r(typename C::Waits{}));
    });
    w.for_readers_by_number([](auto& r) { r.when(r(Contacted{}), [&] { C::heartbeat(r); }); });
  }

 private:
  /// What a request to arm needs: it looks neither at the readers nor at the cycle.
  template <class W>
  static HeartbeatTimerIo::Input<typename W::D> time_and_policy(W& w) {
    HeartbeatTimerIo::Input<typename W::D> in;
    in.now = w(Now{});
    in.heartbeat_period = w(HeartbeatPeriod{});
    in.adaptive = w(Adaptive{});
    in.additive = w(Additive{});
    return in;
  }
  template <class Event, class W>
  static void request(W& w) {
    w.call(ClockGoesOn{}, w.feed(HeartbeatClock{}, on<Event>, time_and_policy(w)));
  }

  template <class Event, class W>
  static auto feed(W& w) {
    HeartbeatTimerIo::Input<typename W::D> in = time_and_policy(w);
    in.pending = w(Pending<HeartbeatExpiry>{});
    in.unacknowledged = w(typename C::NeedsHeartbeat{});
    in.cycle.start = w(CycleBegan{});
    in.cycle.period = w(CyclePeriod{});
    in.cycle.contacted = w(ContactedCount{});
    in.cycle.responded = w(RespondedCount{});
    in.cycle.min_period = w(MinPeriod{});
    in.cycle.max_period = w(MaxPeriod{});
    in.cycle.epsilon_num = w(EpsilonNumerator{});
    in.cycle.epsilon_den = w(EpsilonDenominator{});
    return w.feed(HeartbeatClock{}, on<Event>, in);
  }

  template <class Event, class W>
  static void step(W& w) {
    w.call(ClockGoesOn{}, feed<Event>(w));
  }

  struct ClockGoesOn : Procedure {
    template <class W, class Outbox>
    static void body(W& w, const Outbox& clock) {
      w.when(!w(Adaptive{}), [&] {
        w.when(clock.send, [&] { C::periodic(w); });
        w.when(clock.schedule_expiry, [&] { w.at(clock.next_at, HeartbeatExpiry{}); });
      });
      w.when(w(Adaptive{}), [&] { w.call(CycleGoesOn{}, clock); });
    }
  };

  struct CycleGoesOn : Procedure {
    template <class W, class Outbox>
    static void body(W& w, const Outbox& clock) {
      w.when(clock.invalidate, [&] {
        w.cancel(CycleStart{});
        w.cancel(CycleEnd{});
        w.cancel(BatchDue{});
      });
      w.when(clock.send, [&] { contact(w); });
      w.when(clock.pace, [&] { w.perform(PlanBatches{}, clock.period); });
      w.when(clock.period > 0, [&] { w.set(CyclePeriod{}, clock.period); });
      w.when(clock.schedule_cycle, [&] { w.at(clock.next_at, CycleStart{}); });
      w.when(clock.schedule_end, [&] { w.at(clock.next_at, CycleEnd{}); });
      w.when(clock.send_batch, [&] { w.perform(SendBatch{}); });
    }
  };
};

}  // namespace stormproof::fsm::composition
