// The proof that a descriptor is received within B(k) after its relation opens
// (specs/guide/bounds.md). Four steps:
//   1. A HEARTBEAT whose exchange is not spoilt leads to reception within F = 3Δ + τ_A + τ_N.
//   2. A lost repair spoils only HEARTBEATs within a window of W = 2(Δ − μ) + σ + τ_N + τ_S.
//   3. A window of W holds at most s + 1 periodic HEARTBEATs, s = ⌊W/τ_H⌋.
//   4. So with each loss the first HEARTBEAT that is not spoilt moves by at most (s + 1)·τ_H: an
//      inductive invariant over the periodic HEARTBEATs, with a ghost bound that grows with the
//      losses, because k·τ_H would not be linear.
#include "checker/engines/timeline/completion_theorem.hpp"

#include "checker/engines/timeline/adversary.hpp"

namespace stormproof::timeline {
namespace {

/// A writer that is in U (as far as `asked` goes) and a reader that has received nothing.
Descriptor<Sym> idle_descriptor(Theorem& t) {
  Descriptor<Sym> d;
  d.asked = t.choice("asked_before");
  d.busy_until = t.number("busy_before");
  return d;
}

/// A HEARTBEAT and its ACKNACK, on time and not lost.
struct Exchange {
  Exchange(Theorem& t, const Parameters& p, const std::string& name)
      : sent{t.number(name)},
        report{answer<Sym>(sent, p.passage(t, name + "_heartbeat"), p.passage(t, name + "_acknack"),
                           p.timers)},
        repair{p.passage(t, name + "_repair")} {}

  Int sent;
  Report<Sym> report;
  Passage<Sym> repair;
};

Int answered_within(const Parameters& p) {
  return p.delta + p.delta + p.delta + p.timers.response + p.timers.nack;
}

Int window(const Parameters& p) {
  return p.delta - p.least + p.delta - p.least + p.source + p.timers.nack + p.timers.suppression;
}

/// Step 1: the exchange of a HEARTBEAT delivers, whether its ACKNACK requests the repair or finds
/// one that is under way, unless a packet of it is lost.
void exchange_delivers(Theorem& t, const Parameters& p, const Int& within) {
  const std::size_t mark = t.open();
  Descriptor<Sym> d = idle_descriptor(t);
  const Exchange first{t, p, "first"};
  const Exchange second{t, p, "second"};
  t.assume(!first.report.lost && !first.repair.lost && !second.report.lost);
  const Effect<Sym> asked = acknack<Sym>(d, first.report, first.repair, p.timers);
  t.assume(asked.requested && first.report.arrives <= second.report.arrives);
  const Effect<Sym> again = acknack<Sym>(d, second.report, second.repair, p.timers);
  generate<Sym>(d, true);
  t.holds("an exchange that requests the descriptor delivers it within F",
          d.received && d.received_at <= first.sent + within);
  t.holds("an exchange that finds its repair under way has it within F",
          implies(again.listed && !again.requested,
                  d.received && d.received_at <= second.sent + within));
  t.close(mark);
}

/// Step 2: HEARTBEATs whose ACKNACKs find the descriptor requested, queued or suppressed because of
/// one repair are sent within a window.
void loss_spoils_a_window(Theorem& t, const Parameters& p, const Int& width) {
  const std::size_t mark = t.open();
  Descriptor<Sym> d = idle_descriptor(t);
  const Exchange first{t, p, "first"};
  const Effect<Sym> asked = acknack<Sym>(d, first.report, first.repair, p.timers);
  t.assume(asked.requested);
  const Exchange one{t, p, "one"};
  const Exchange other{t, p, "other"};
  t.assume(first.report.arrives <= one.report.arrives && one.report.arrives <= d.busy_until);
  t.assume(first.report.arrives <= other.report.arrives && other.report.arrives <= d.busy_until);
  t.holds("HEARTBEATs spoilt by one repair are sent within W", other.sent - one.sent <= width);
  t.holds("and so is the one that asked for it",
          other.sent - first.sent <= width && first.sent - other.sent <= width);
  t.close(mark);
}

/// Step 3, the only product: s + 1 periods are longer than W.
void window_holds_few(Theorem& t, const Parameters& p) {
  const std::size_t mark = t.open();
  const Int s = t.at_least("s", 0);
  const Int passed = t.at_least("passed", 0);  // periods between two HEARTBEATs of one window
  t.assume(window(p) < (s + 1) * p.period);
  t.assume(passed * p.period <= window(p));
  t.holds("a window of W spoils at most s + 1 periodic HEARTBEATs", passed <= s);
  t.close(mark);
}

/// Step 4.
void losses_delay_by_periods(Theorem& t, const Parameters& p, const Int& less) {
  const std::size_t mark = t.open();
  Adversary<Sym> a;
  a.next = t.number("next");
  a.spoilt = t.at_least("spoilt", 0);
  a.spoilt_time = t.number("spoilt_time");
  a.limit = t.number("limit");
  const Int s = t.at_least("s", 0);
  const Int s_periods = t.number("s_periods");  // s·τ_H
  t.assume(s_periods == s * p.period);
  t.assume(s_periods <= window(p) && window(p) < s_periods + p.period);
  const auto step = [&](const char* name, const Bool& enabled, const Adversary<Sym>& after) {
    t.holds(name, implies(invariant<Sym>(a, p.period) && enabled, invariant<Sym>(after, p.period)));
  };
  const Int phase = t.within("phase", 0, p.period);
  const Int covered = t.at_least("covered", 0);  // periodic HEARTBEATs in the opening's window
  const Int covered_time = t.number("covered_time");
  t.assume(covered_time == covered * p.period);
  const Bool in_window = covered == 0 || phase + covered_time <= window(p) + p.period;
  step("the opening, at any phase of the timer", in_window,
       opened<Sym>(phase, covered, covered_time, window(p) + p.period - less));
  step("the opening, if the timer starts with it", phase == p.period && in_window && covered <= s,
       opened<Sym>(phase, covered, covered_time, s_periods + p.period - less));
  step("a lost HEARTBEAT or ACKNACK", true, lose_exchange<Sym>(a, s_periods, p.period));
  step("a lost repair", true, lose_repair<Sym>(a, s, s_periods, p.period));
  step("a HEARTBEAT in the window of a lost repair", a.spoilt > 0, pass_spoilt<Sym>(a, p.period));
  t.holds("the next HEARTBEAT comes within the limit",
          implies(invariant<Sym>(a, p.period), a.next <= a.limit));
  t.close(mark);
}

}  // namespace

void prove_completion(Theorem& theorem, const Tightening& tighter) {
  const Parameters p{theorem};
  exchange_delivers(theorem, p, answered_within(p) - tighter.exchange);
  loss_spoils_a_window(theorem, p, window(p) - tighter.window);
  window_holds_few(theorem, p);
  losses_delay_by_periods(theorem, p, tighter.opening);
}

}  // namespace stormproof::timeline
