// Schedules with repairs that nothing makes necessary: counterexamples of storm.free-threshold and
// storm.single-copy, and the boundary points of both theorems.
#pragma once

#include <vector>

#include "checker/engines/timeline/directed_check.hpp"

namespace stormproof::timeline {

/// A scenario of two participants with this scenario's DDS profile in which, without loss and with
/// no delay above `delta`, the property's monitor objects. Nothing if none is found.
[[nodiscard]] std::optional<props::Counterexample> needless_repair(const model::Scenario& scenario,
                                                                   std::string_view property,
                                                                   model::Nanoseconds delta);

/// Whether a reader asks for everything in its initial ACKNACK, without a HEARTBEAT.
[[nodiscard]] bool asks_by_itself(const model::SedpProfile& sedp);

/// DATA that arrives at the instant of the ACKNACK's generation, and a nanosecond later.
[[nodiscard]] std::vector<BoundaryPoint> threshold_points(const model::DdsProfile& dds);

/// Two HEARTBEATs as far apart as the borders of the condition, and a nanosecond inside of them.
[[nodiscard]] std::vector<BoundaryPoint> single_copy_points(const model::DdsProfile& dds);

}  // namespace stormproof::timeline
