// The timeline of one descriptor of one relation: from each HEARTBEAT to its ACKNACK to the repair,
// as arithmetic on times instead of events in a queue. It restates the writer's and the reader's
// rules (specs/guide/model.md; derivations in specs/guide/bounds.md), so it is written once, over a
// domain (fsm/domain.hpp): the solvers get the very text that the bridge in
// tests/checker/engines/timeline evaluates on numbers and holds against runs of the machines.
//
// Why one descriptor is enough: a relation's descriptors meet only in shared packets and in the
// repair generations and suppression ends of each other, and those can only make a descriptor leave
// R or S earlier.
#pragma once

#include "fsm/domain.hpp"

namespace stormproof::timeline {

/// The reply delays of a profile; ns.
template <class D>
struct Timers {
  typename D::Int response{};     ///< τ_A, HEARTBEAT to ACKNACK
  typename D::Int nack{};         ///< τ_N, ACKNACK to repair
  typename D::Int suppression{};  ///< τ_S, from the repair's leaving its source
};

/// What the network does to one packet.
template <class D>
struct Passage {
  typename D::Int delay{};   ///< from emission to reception, ns
  typename D::Int leaves{};  ///< from emission until it has left its source, ns
  typename D::Bool lost{};
};

/// An ACKNACK.
template <class D>
struct Report {
  typename D::Int generated{};
  typename D::Int arrives{};
  typename D::Bool lost{};  ///< it, or the HEARTBEAT that should have caused it
};

/// The descriptor: X at the reader, C at the writer.
template <class D>
struct Descriptor {
  typename D::Bool received{};  ///< X will be 1, from `received_at` on
  typename D::Int received_at{};
  typename D::Bool acknowledged{};  ///< C = A
  typename D::Int acknowledged_at{};
  typename D::Bool asked{};      ///< C has been R, Q or S until now or until `busy_until`
  typename D::Int busy_until{};  ///< up to and including: a reception precedes the suppression end
  typename D::Bool queued{};     ///< a repair generation is due that has not been looked at yet
  typename D::Int repair_at{};   ///< when
  Passage<D> repair{};           ///< what the network will do to it
  typename D::Int repairs{};     ///< generated so far
};

/// What an ACKNACK did.
template <class D>
struct Effect {
  typename D::Bool listed{};     ///< its bitmap asks for the descriptor
  typename D::Bool requested{};  ///< U → R
};

/// DATA emitted at `sent`.
template <class D>
void deliver(Descriptor<D>& d, const typename D::Int& sent, const Passage<D>& passage,
             const typename D::Bool& happens) {
  const typename D::Int at = sent + passage.delay;
  const typename D::Bool arrives = happens && !passage.lost;
  const typename D::Bool earlier = arrives && (!d.received || at < d.received_at);
  d.received_at = D::select(earlier, at, d.received_at);
  d.received = d.received || arrives;
}

/// The ACKNACK that answers a HEARTBEAT emitted at `sent`.
template <class D>
Report<D> answer(const typename D::Int& sent, const Passage<D>& heartbeat,
                 const Passage<D>& acknack, const Timers<D>& timers) {
  const typename D::Int generated = sent + heartbeat.delay + timers.response;
  return {generated, generated + acknack.delay, heartbeat.lost || acknack.lost};
}

/// The repair that was asked for is generated, if `now` is: nothing can cancel it any more.
template <class D>
void generate(Descriptor<D>& d, const typename D::Bool& now) {
  const typename D::Bool due = d.queued && now;
  deliver<D>(d, d.repair_at, d.repair, due);
  d.repairs = d.repairs + D::select(due, 1, 0);
  d.queued = d.queued && !due;
}

/// An ACKNACK reaches the writer. To be called in the order of arrivals. Should it request the
/// descriptor, `repair` is what the network does to the repair. Ties: the repair generation at the
/// instant of an arrival comes after it, a reception at the instant of a generation before it.
template <class D>
Effect<D> acknack(Descriptor<D>& d, const Report<D>& report, const Passage<D>& repair,
                  const Timers<D>& timers) {
  generate<D>(d, d.repair_at < report.arrives);
  Effect<D> effect;
  effect.listed = !(d.received && d.received_at <= report.generated);
  const typename D::Bool idle = !(d.asked && report.arrives <= d.busy_until);
  const typename D::Bool heard = !report.lost && !d.acknowledged;
  effect.requested = heard && effect.listed && idle;
  const typename D::Bool confirms = heard && !effect.listed;

  d.acknowledged_at = D::select(confirms, report.arrives, d.acknowledged_at);
  d.acknowledged = d.acknowledged || confirms;
  d.queued = (d.queued && !confirms) || effect.requested;
  d.asked = d.asked || effect.requested;
  const typename D::Int repair_at = report.arrives + timers.nack;
  d.repair_at = D::select(effect.requested, repair_at, d.repair_at);
  d.busy_until =
      D::select(effect.requested, repair_at + repair.leaves + timers.suppression, d.busy_until);
  d.repair.delay = D::select(effect.requested, repair.delay, d.repair.delay);
  d.repair.leaves = D::select(effect.requested, repair.leaves, d.repair.leaves);
  d.repair.lost = (effect.requested && repair.lost) || (!effect.requested && d.repair.lost);
  return effect;
}

}  // namespace stormproof::timeline
