// The game behind the completion bound: a network that loses packets against a writer that sends
// periodic HEARTBEATs. The state says when the next HEARTBEAT is sent and how many of those to come
// are spoilt by repairs that are lost already; `limit` is a ghost: the bound that has been proved
// so far. It grows by (s + 1)·τ_H with each loss, so that the bound needs no product with k.
#pragma once

#include "fsm/domain.hpp"

namespace stormproof::timeline {

template <class D>
struct Adversary {
  typename D::Int next{};         ///< when the next periodic HEARTBEAT is sent, after the opening
  typename D::Int spoilt{};       ///< how many from it on are spoilt at most
  typename D::Int spoilt_time{};  ///< spoilt · τ_H
  typename D::Int limit{};        ///< ghost
};

/// Holds after every step. The product is the definition of `spoilt_time`.
template <class D>
typename D::Bool invariant(const Adversary<D>& a, const typename D::Int& period) {
  return a.spoilt >= 0 && a.spoilt_time == a.spoilt * period && a.next + a.spoilt_time <= a.limit;
}

/// The relation has opened, its DATA is lost, and so is the repair that the HEARTBEAT of the
/// opening (at 0) asks for; `covered` periodic HEARTBEATs, from `phase` on, lie in the window of
/// that loss.
template <class D>
Adversary<D> opened(const typename D::Int& phase, const typename D::Int& covered,
                    const typename D::Int& covered_time, const typename D::Int& limit) {
  return {phase, covered, covered_time, limit};
}

/// The next HEARTBEAT, or its ACKNACK, is lost.
template <class D>
Adversary<D> lose_exchange(const Adversary<D>& a, const typename D::Int& s_periods,
                           const typename D::Int& period) {
  return {a.next + period, a.spoilt, a.spoilt_time, a.limit + s_periods + period};
}

/// The repair that the next HEARTBEAT leads to is lost; s more HEARTBEATs lie in its window.
template <class D>
Adversary<D> lose_repair(const Adversary<D>& a, const typename D::Int& s,
                         const typename D::Int& s_periods, const typename D::Int& period) {
  return {a.next + period, a.spoilt + s, a.spoilt_time + s_periods, a.limit + s_periods + period};
}

/// The next HEARTBEAT is one of the spoilt ones.
template <class D>
Adversary<D> pass_spoilt(const Adversary<D>& a, const typename D::Int& period) {
  return {a.next + period, a.spoilt - 1, a.spoilt_time - period, a.limit};
}

}  // namespace stormproof::timeline
