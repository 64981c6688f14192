// The HEARTBEAT clock of the amended rules: the paper's (fsm/composition/heartbeat_clock.hpp), or
// one whose period follows the answers of its readers, as OpenDDS had it (`heartbeat_policy:
// measured_ack`). Each expiry starts a cycle that asks every reader that waits; it is over when all
// have answered, or at the next expiry, and then the period is twice as long. `C` is the
// implementation, as the paper's clock has it.
// Source: specs/guide/museum.md, "The amended rules".
#pragma once

#include "fsm/composition/amended_parts.hpp"
#include "fsm/composition/heartbeat_clock.hpp"

namespace stormproof::fsm::composition::amended {

/// The cycle has asked the reader, which has not answered.
struct IsAwaited : Fact {
  template <class W>
  static auto of(W& w) {
    return w(Contacted{}) && !w(Responded{});
  }
};
struct SomeoneIsAwaited : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto& r) { return r(IsAwaited{}); });
  }
};

struct TimeToAnswer : Fact {
  template <class W>
  static auto of(W& w) {
    return w(Now{}) - w(CycleBegan{});
  }
};

template <class C>
struct MeasuredClock : ClockRules<C> {
  using Usual = ClockRules<C>;

  template <class W>
  static void arm(W& w) {
    w.when(!w(MeasuresAcks{}), [&] { Usual::arm(w); });
    w.when(w(MeasuresAcks{}), [&] { w.call(BeginMeasuring{}); });
  }
  template <class W>
  static void suppression_ended(W& w) {
    w.when(!w(MeasuresAcks{}), [&] { Usual::suppression_ended(w); });
    w.when(w(MeasuresAcks{}), [&] { w.call(BeginMeasuring{}); });
  }
  /// An ordinary ACKNACK of this relation's reader has been taken, whatever it asks for.
  template <class W>
  static void answered(W& w) {
    w.when(w(MeasuresAcks{}) && w(IsAwaited{}), [&] { w.call(Measure{}); });
  }

  struct HeartbeatExpires : Rule<Due<HeartbeatExpiry>> {
    template <class W>
    static void run(W& w) {
      w.when(!w(MeasuresAcks{}), [&] { Usual::HeartbeatExpires::run(w); });
      w.when(w(MeasuresAcks{}), [&] {
        w.when(w(SomeoneIsAwaited{}), [&] {
          w.set(CyclePeriod{}, 2 * w(CyclePeriod{}));
          w.call(BoundPeriod{});
        });
        w.call(AskThoseWhoWait{});
      });
    }
  };

  using Rules = TypeList<HeartbeatExpires, typename Usual::CycleStarts, typename Usual::CycleEnds,
                         typename Usual::BatchIsDue>;

 private:
  struct BeginMeasuring : Procedure {
    template <class W>
    static void body(W& w) {
      w.when(!(w(Pending<HeartbeatExpiry>{}) > 0), [&] {
        w.set(CyclePeriod{}, w(HeartbeatPeriod{}));
        w.after(HeartbeatPeriod{}, HeartbeatExpiry{});
      });
    }
  };
  struct BoundPeriod : Procedure {
    template <class W>
    static void body(W& w) {
      w.when(w(ShortestMeasured{}) > w(CyclePeriod{}),
             [&] { w.set(CyclePeriod{}, w(ShortestMeasured{})); });
      w.when(w(CyclePeriod{}) > w(LongestMeasured{}),
             [&] { w.set(CyclePeriod{}, w(LongestMeasured{})); });
    }
  };
  /// Whoever was asked last has answered: the next cycle starts at once.
  struct Measure : Procedure {
    template <class W>
    static void body(W& w) {
      w.set(Responded{}, typename W::Bool(true));
      w.when(!w(SomeoneIsAwaited{}), [&] {
        w.set(CyclePeriod{}, w(TimeToAnswer{}) * 11 / 10);
        w.call(BoundPeriod{});
        w.cancel(HeartbeatExpiry{});
        w.call(AskThoseWhoWait{});
      });
    }
  };
  struct AskThoseWhoWait : Procedure {
    template <class W>
    static void body(W& w) {
      Usual::contact(w);
      w.when(w(typename C::NeedsHeartbeat{}),
             [&] { w.at(w(Now{}) + w(CyclePeriod{}), HeartbeatExpiry{}); });
    }
  };
};

}  // namespace stormproof::fsm::composition::amended
