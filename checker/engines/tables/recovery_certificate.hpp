// live.recovery from the amended rules (checker/engines/tables/certificate.hpp), for all timers, Δ
// and σ, any number of descriptors, readers, writers and losses: whoever lacks a descriptor asks
// for it by initial ACKNACKs until it has it, whether its writer is new to it as well or believes
// that it has everything. An attempt that is not lost brings it.
#pragma once

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/tables/timed_certificate.hpp"

namespace stormproof::tables {

/// What a writer holds of its reader when the reader's side opens.
enum class Before : std::uint8_t {
  fresh,  ///< nothing
  stale   ///< that it has everything
};

/// B of the property for readers that ask by themselves (props/monitors/recovery_bound.cpp),
/// without the time that announcements take: counted from the last failure, which is `since` after
/// the opening of the reader's side.
template <class D>
[[nodiscard]] typename D::Int recovery_after(const timeline::Delays<D>& t,
                                             const typename D::Int& first,
                                             const typename D::Int& since, bool doubles) {
  const typename D::Int round =
      t.period + t.delta + t.delta + t.delta + t.response + t.nack + t.suppression;
  const typename D::Int completion = t.delta + round + round + round + round;
  return doubles ? since + first + first + completion : first + completion;
}

/// With the mutant's mistakes, and that of a bound which is too small. A check decides the bound
/// that is claimed once.
[[nodiscard]] props::Finding recovery_certificate(const checker::CheckRequest& request,
                                                  Before before, const Tighter& mistake = {});

}  // namespace stormproof::tables
