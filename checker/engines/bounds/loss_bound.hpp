// How long a reader can lack a descriptor, if each lost packet costs the same time: the form of the
// completion bound that follows from the rules for every writer (checker/engines/tables/
// completion_certificate.cpp proves it). One text for numbers and for solvers.
#pragma once

#include "fsm/domain.hpp"
#include "model/implementations.hpp"

namespace stormproof::timeline {

/// What the bound depends on; ns.
template <class D>
struct Delays {
  typename D::Int period{};       ///< τ_H ≥ 1
  typename D::Int response{};     ///< τ_A
  typename D::Int nack{};         ///< τ_N
  typename D::Int suppression{};  ///< τ_S
  typename D::Int delta{};        ///< Δ
  typename D::Int source{};       ///< σ ≤ Δ
};

/// After k losses a descriptor is received within `first` + k·`loss` + `exchange`, counted from
/// when both sides are open and it exists.
template <class D>
struct Losses {
  typename D::Int first{};     ///< until a HEARTBEAT is sent that finds it in U
  typename D::Int loss{};      ///< L: by how much a loss puts that off
  typename D::Int exchange{};  ///< F: HEARTBEAT, ACKNACK, repair
};

/// The reader may open after the writer and then drops what reaches it before.
[[nodiscard]] inline bool may_open_late(const model::DdsProfile& dds) {
  const model::RelationRules rules = model::rules_of(dds);
  return rules.relation_opening == model::RelationOpening::each_side &&
         rules.unmatched == model::Unmatched::drop;
}

template <class D>
[[nodiscard]] Losses<D> losses(const model::DdsProfile& dds, const Delays<D>& t) {
  const model::ImplementationTraits& traits = model::traits_of(dds);
  const typename D::Int asked = t.delta + t.delta + t.response + t.nack;
  Losses<D> bound;
  bound.exchange = asked + t.delta;
  bound.loss = asked + t.suppression + t.period;
  if (traits.waits_for_source) bound.loss = bound.loss + t.source;
  if (may_open_late(dds)) bound.first = t.period;
  // What exists is suppressed already if it was pushed at its creation.
  if (traits.creates_endpoints_over_time) bound.first = bound.first + t.suppression;
  return bound;
}

}  // namespace stormproof::timeline
