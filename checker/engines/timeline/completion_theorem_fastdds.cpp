// The completion bound for Fast DDS's writer (specs/guide/bounds.md). Its timer dies at an expiry
// that finds nothing unacknowledged, for example because all is suppressed, so the periodic
// HEARTBEATs have no fixed phase. What is left: from the end of a suppression on, an expiry is
// pending within τ_H, and as long as the descriptor stays in U it sends a HEARTBEAT. Each loss
// therefore moves that expiry by at most L = τ_H + 2Δ + τ_A + τ_N + τ_S, in which everything is
// linear.
#include "checker/engines/timeline/completion_theorem.hpp"

namespace stormproof::timeline {
namespace {

/// The ACKNACK that a HEARTBEAT emitted at `sent` leads to. It may share the one that an earlier
/// HEARTBEAT has scheduled, and then comes sooner.
Report<Sym> shared_answer(Theorem& t, const Parameters& p, const Int& sent) {
  const Int received = sent + t.within("heartbeat_delay", 0, p.delta);
  Report<Sym> report;
  report.generated = t.within("generated", received, received + p.timers.response);
  report.arrives = report.generated + t.within("acknack_delay", 0, p.delta);
  return report;
}

/// The descriptor is in U and an expiry is pending at `expiry`, at most `limit`. What happens next:
/// it is requested by an ACKNACK that an earlier HEARTBEAT has caused, or the expiry sends a
/// HEARTBEAT, whose exchange is lost or requests it (or finds it requested since).
void one_round(Theorem& t, const Parameters& p, const Tightening& tighter) {
  const std::size_t mark = t.open();
  const Int loss_costs = p.period + p.delta + p.delta + p.timers.response + p.timers.nack +
                         p.timers.suppression - tighter.window;
  const Int within =
      p.delta + p.delta + p.delta + p.timers.response + p.timers.nack - tighter.exchange;
  const Int limit = t.number("limit");
  const Int expiry = t.number("expiry");
  t.assume(expiry <= limit);

  Descriptor<Sym> d;
  Report<Sym> report = shared_answer(t, p, expiry);
  const Int other = t.number("request_by_another");
  const Bool earlier = t.choice("requested_by_another");
  t.assume(implies(earlier, other <= report.arrives));
  report.arrives = Sym::select(earlier, other, report.arrives);
  Passage<Sym> repair;  // S begins with serialization, so leaving the source takes no part
  repair.delay = t.within("repair_delay", 0, p.delta);
  repair.lost = t.choice("repair_lost");
  const Effect<Sym> effect = acknack<Sym>(d, report, repair, p.timers);
  t.possible("a round can request the descriptor", effect.requested);
  // The suppression timer is the relation's: another descriptor's may end it sooner.
  const Int until = t.number("suppression_ends");
  t.assume(until <= d.busy_until);
  const Int next_expiry = t.number("next_expiry");
  t.assume(next_expiry <= until + p.period);
  generate<Sym>(d, true);
  t.holds("an exchange that is not lost delivers within F of the expiry",
          implies(!repair.lost, d.received && d.received_at <= limit + within));
  t.holds("a lost repair moves the expiry by at most L", next_expiry <= limit + loss_costs);
  t.holds("a lost HEARTBEAT or ACKNACK moves the expiry by at most L",
          expiry + p.period <= limit + p.period + p.delta + p.delta + p.timers.response +
                                   p.timers.nack + p.timers.suppression);
  t.close(mark);
}

/// After a descriptor is pushed it is suppressed for at most τ_S; the timer is armed by then.
void pushed(Theorem& t, const Parameters& p, const Tightening& tighter) {
  const std::size_t mark = t.open();
  const Int ends = t.within("suppression_ends", 0, p.timers.suppression);
  const Int expiry = t.number("expiry");
  t.assume(expiry <= ends + p.period);
  t.holds("after a lost push an expiry finds the descriptor within τ_S + τ_H",
          expiry <= p.timers.suppression + p.period - tighter.opening);
  t.close(mark);
}

}  // namespace

void prove_completion_fastdds(Theorem& theorem, const Tightening& tighter) {
  const Parameters p{theorem};
  one_round(theorem, p, tighter);
  pushed(theorem, p, tighter);
}

}  // namespace stormproof::timeline
