// How long SEDP traffic may go on once discovery is complete and nothing more is lost. The argument
// stands in quiescence.cpp.
#pragma once

#include <memory>

#include "model/dds_profile.hpp"
#include "model/units.hpp"
#include "props/monitors/data_observer.hpp"
#include "props/monitors/delay_observer.hpp"

namespace stormproof::props {

/// The longest time, ≥ 0, from the instant from which everything is received and every relation is
/// open to the last DATA, HEARTBEAT or ACKNACK, if no packet takes longer than `delay`.
[[nodiscard]] model::Nanoseconds quiescence_bound(const model::DdsProfile& dds,
                                                  model::Nanoseconds delay);

/// The monitor of live.quiescence. It decides in `finish`.
class QuiescenceMonitor : public DataObserver<DelayObserver> {
 public:
  using DataObserver::DataObserver;
  /// From then on there must be no traffic, if no packet takes longer than those up to `now`.
  /// Absent: something is missing or not open.
  [[nodiscard]] virtual std::optional<model::Nanoseconds> silent_from(
      model::Nanoseconds now) const = 0;
};

[[nodiscard]] std::unique_ptr<QuiescenceMonitor> make_quiescence_monitor(const model::Scenario&);

}  // namespace stormproof::props
