// The second HEARTBEAT's ACKNACK lists the descriptor iff the first one's repair has not arrived
// when it is generated, and requests it iff the suppression is over when it arrives. Every packet
// takes the same time, so both ACKNACKs are g apart, too.
#include "checker/engines/timeline/single_copy.hpp"

namespace stormproof::timeline {
namespace {

/// Whether the second of two HEARTBEATs, at 0 and at `gap`, requests again what the first one did.
Bool needless(const Int& delta, const Int& leaves, const Int& gap, const Timers<Sym>& timers) {
  const Passage<Sym> passage{delta, leaves, false};
  Descriptor<Sym> d;
  acknack<Sym>(d, answer<Sym>(0, passage, passage, timers), passage, timers);
  return acknack<Sym>(d, answer<Sym>(gap, passage, passage, timers), passage, timers).requested;
}

}  // namespace

void prove_single_copy(Theorem& t, const BorderShift& shift) {
  const Parameters p{t};
  const Int leaves = t.within("lambda", 0, p.delta);
  const Int gap = t.at_least("g", 0);
  const Int lower = p.timers.nack + p.timers.suppression + shift.lower;
  const Int upper = p.delta + p.delta + p.timers.nack + shift.upper;

  const Bool again = needless(p.delta, leaves, gap, p.timers);
  t.holds("needless repair iff lambda + tau_N + tau_S < g < 2 delta + tau_N",
          again == (leaves + lower < gap && gap < upper));
  t.possible("a needless repair is possible", again);
  t.possible("and so is none", !again);

  // Fast DDS: a HEARTBEAT that is received while an ACKNACK is pending causes none of its own, and
  // suppression starts when the repair is serialized.
  const Bool own_acknack = gap > p.timers.response;
  t.holds("needless repair, Fast DDS", (own_acknack && needless(p.delta, 0, gap, p.timers)) ==
                                           (own_acknack && lower < gap && gap < upper));

  // A HEARTBEAT that is sent with or after the DATA finds it received.
  const Passage<Sym> passage{p.delta, leaves, false};
  Descriptor<Sym> pushed;
  deliver<Sym>(pushed, 0, passage, true);
  t.holds("pushed DATA is not repaired because of a HEARTBEAT",
          !acknack<Sym>(pushed, answer<Sym>(gap, passage, passage, p.timers), passage, p.timers)
               .requested);
}

}  // namespace stormproof::timeline
