// What confirms a stall of Cyclone DDS that its monitor (props/monitors/cyclone_stalls.cpp) cannot
// see, because the writer's HEARTBEAT timer goes on: the explorer says that from the end of a path
// nothing leads to reception, and so the samples have to be missing long after it, although no
// packet is lost any more.
#pragma once

#include "checker/engines/explorer/scope.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::explorer {

/// Objects at the end of a run if participant 1 lacks one of the scope's samples of the
/// publications of participant 0.
[[nodiscard]] props::MonitorPtr watch_lacking_samples(const Scope& scope);

/// How long after the end of a path the samples must have come: every timer of the rules has been
/// due several times by then.
[[nodiscard]] model::Nanoseconds long_enough(const model::DdsProfile& dds);

}  // namespace stormproof::explorer
