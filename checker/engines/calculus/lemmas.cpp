// The steps of the proof as conditions for the solvers, with all timers symbolic.
#include <fmt/core.h>

#include "checker/engines/calculus/cannot_start.hpp"
#include "checker/engines/timeline/theorem.hpp"

namespace stormproof::calculus {

namespace {

using timeline::Bool;
using timeline::implies;
using timeline::Int;
using timeline::Sym;
using timeline::Theorem;
using Descriptor = timeline::Descriptor<Sym>;
using Passage = timeline::Passage<Sym>;
using Report = timeline::Report<Sym>;

/// A channel that is busy since `begin` has served one nanosecond of work in each nanosecond.
void prove_busy_period(Theorem& t) {
  const std::size_t mark = t.open();
  const Int length = t.at_least("busy_bound", 0);
  const Int curve = t.within("curve_at_bound", 0, length);
  const Int arrived = t.within("arrived_within_bound", 0, curve);
  const Int begin = t.number("busy_since");
  t.holds("a busy period is over when its work is done", arrived - length <= 0);
  const Int emitted = t.at_least("emitted", begin);
  const Int received = t.within("received", emitted, begin + length);
  t.holds("what comes in a busy period goes with it", received - emitted <= length);
  const Int limit = t.at_least("threshold", length);
  t.holds("so nothing is late for the first time", received - emitted <= limit);
  t.close(mark);
}

/// Counts of arrivals: spacing, and windows of what answers a packet.
void prove_counts(Theorem& t) {
  const std::size_t mark = t.open();
  const Int period = t.at_least("period", 1);
  const Int periods = t.at_least("period_times_events_less_one", 0);  // (n − 1)·τ, as a ghost
  const Int span = t.at_least("span_of_events", periods);
  const Int gap = t.at_least("gap", period);
  t.holds("one more event, one more period", span + gap >= periods + period);
  const Int window = t.at_least("window", span);
  t.holds("events of a window fit into it", periods <= window);
  const Int other = t.at_least("a", 0);
  const Int curve = t.at_least("curve_a", other);
  const Int second = t.at_least("b", 0);
  const Int second_curve = t.at_least("curve_b", second);
  t.holds("curves add up", other + second <= curve + second_curve);
  const Int delay = t.at_least("delay_bound", 0);
  const Int begin = t.number("window_begin");
  const Int cause = t.number("cause");
  const Int under_way = t.within("under_way", 0, delay);
  const Int reply = t.at_least("reply_delay", 0);
  const Int answer = cause + under_way + reply;
  t.assume(answer >= begin && answer <= begin + window);
  const Int first = begin - reply - delay;
  t.holds("answers of a window have causes of one that is longer by a delay",
          cause >= first && cause - first <= window + delay);
  t.close(mark);
}

struct Timing {
  Int delta;
  timeline::Timers<Sym> timers;
  Int initial;

  explicit Timing(Theorem& t)
      : delta{t.at_least("delta", 0)},
        timers{t.at_least("tau_A", 0), t.at_least("tau_N", 0), t.at_least("tau_S", 0)},
        initial{t.at_least("tau_I", 0)} {}

  Passage passage(Theorem& t, const char* name) const {
    return {t.within(std::string{name} + "_delay", 0, delta), 0, false};
  }
};

/// Pushed DATA, the first ACKNACK that could ask for it.
void prove_pushed(Theorem& t, Lemma lemma) {
  const std::size_t mark = t.open();
  const Timing p{t};
  const Passage data = p.passage(t, "data");
  const Passage heartbeat = p.passage(t, "heartbeat");
  const Passage acknack = p.passage(t, "acknack");
  const Int sent = t.at_least("sent", 0);
  Descriptor pushed;
  timeline::deliver<Sym>(pushed, 0, data, true);
  Descriptor own = pushed;
  const auto asked = [&](Descriptor& d, const Report& report) {
    return timeline::acknack<Sym>(d, report, {}, p.timers).requested;
  };
  const Report answer = timeline::answer<Sym>(sent, heartbeat, acknack, p.timers);
  if (lemma == Lemma::any_order) {
    t.holds("no ACKNACK to a HEARTBEAT asks if Δ ≤ τ_A",
            implies(p.delta <= p.timers.response, !asked(pushed, answer)));
  } else {
    t.holds("no ACKNACK to a HEARTBEAT that arrives after the DATA asks",
            implies(sent + heartbeat.delay >= data.delay, !asked(pushed, answer)));
  }
  const Report initial{p.initial, p.initial + acknack.delay, false};
  t.holds("no initial ACKNACK asks if Δ ≤ τ_I",
          implies(p.delta <= p.initial, !asked(own, initial)));
  t.close(mark);
}

/// Equal delays: what an initial ACKNACK asks for is confirmed before it is sent again.
void prove_constant(Theorem& t) {
  const std::size_t mark = t.open();
  const Timing p{t};
  const Passage passage{p.delta, 0, false};
  Descriptor d;
  timeline::deliver<Sym>(d, 0, passage, true);
  t.assume(p.initial > 0);
  timeline::acknack<Sym>(d, {p.initial, p.initial + p.delta, false}, passage, p.timers);
  timeline::acknack<Sym>(d, timeline::answer<Sym>(0, passage, passage, p.timers), passage,
                         p.timers);
  timeline::generate<Sym>(d, true);
  const Bool early = p.delta <= p.initial;
  const Bool confirmed = p.delta + p.timers.response <= p.initial + p.timers.nack;
  t.holds("nothing is sent again if Δ ≤ τ_I + max(0, τ_N − τ_A)",
          implies(early || confirmed, d.repairs == 0));
  t.close(mark);
}

/// The stateful writer. An ACKNACK that is generated at 0 asks for a descriptor, which is sent
/// within τ_N of its arrival; another one asks again.
void prove_stateful(Theorem& t, Lemma lemma) {
  const std::size_t mark = t.open();
  const Timing p{t};
  const Passage first = p.passage(t, "first_acknack");
  const Passage second = p.passage(t, "second_acknack");
  const Passage data = p.passage(t, "data");
  const Int serialized = t.within("serialized", first.delay, first.delay + p.timers.nack);
  const Int received = serialized + data.delay;
  if (lemma == Lemma::patient_reader) {
    t.assume(p.delta + p.delta + p.timers.nack <= p.timers.response);
    const Int later = t.at_least("generated_later", p.timers.response);
    t.holds("an ACKNACK after the one that asked does not list it", received <= later);
    const Int earlier = t.number("generated_earlier");
    t.assume(earlier + p.timers.response <= 0);
    t.holds("an ACKNACK before it arrives before it", earlier + second.delay <= first.delay);
  } else {
    t.assume(p.delta + p.delta <= p.timers.suppression + 1);
    const Int generated = t.number("generated");
    t.assume(generated < received);  // a reception at the instant of a generation comes first
    t.holds("an ACKNACK that lists it arrives before its suppression ends",
            generated + second.delay <= serialized + p.timers.suppression);
  }
  t.close(mark);
}

/// How often as the counts have it, as a condition on a number of occasions.
Int most(Theorem& t, const std::string& name, const Recurrence& when, std::int64_t window,
         std::int64_t delay) {
  const std::int64_t stretched = plus(window, times(when.packets, delay));
  if (when.kind != Recurrence::Kind::periodic) return when.most(window, delay);
  const Int occasions = t.at_least(name, 1);
  t.assume((occasions - 1) * when.period <= stretched && occasions * when.period > stretched);
  return occasions;
}

}  // namespace

void prove_lemmas(Theorem& theorem, Lemma lemma) {
  prove_busy_period(theorem);
  prove_counts(theorem);
  switch (lemma) {
    case Lemma::none:
      break;
    case Lemma::any_order:
    case Lemma::in_order:
      prove_pushed(theorem, lemma);
      break;
    case Lemma::constant_delay:
      prove_constant(theorem);
      break;
    case Lemma::patient_reader:
    case Lemma::long_suppression:
      prove_stateful(theorem, lemma);
      break;
  }
}

void prove_numbers(Theorem& theorem, const OpenLoop& traffic, model::Nanoseconds busy,
                   model::Nanoseconds delay) {
  const std::size_t mark = theorem.open();
  Int sum = 0;
  std::size_t number = 0;
  for (const Flow& flow : traffic.flows) {
    const std::string name = fmt::format("occasions_{}", number++);
    sum = sum + most(theorem, name, flow.when, busy.count(), delay.count()) * flow.airtime;
  }
  theorem.holds("the work of this deployment's longest busy period", sum <= busy.count());
  theorem.close(mark);
}

}  // namespace stormproof::calculus
