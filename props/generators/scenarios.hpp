// Random scenarios for property tests. They use every knob, shrink towards the smallest deployment,
// the fewest changed knobs, the fewest lost packets and round numbers, and print as scenario files.
// The only header of the project that shows RapidCheck; keep it out of other headers.
#pragma once

#include <iosfwd>

#include <rapidcheck.h>

#include "model/scenario.hpp"
#include "props/generators/space.hpp"

namespace stormproof::props {

/// Valid scenarios: what `read_scenario` accepts.
[[nodiscard]] rc::Gen<model::Scenario> scenarios(const ScenarioSpace& space = {});

[[nodiscard]] rc::Gen<model::Deployment> deployments(const ScenarioSpace& space = {});
[[nodiscard]] rc::Gen<model::DdsProfile> dds_profiles(const ScenarioSpace& space = {});
[[nodiscard]] rc::Gen<model::WirelessProfile> wireless_profiles(const ScenarioSpace& space = {});

}  // namespace stormproof::props

namespace stormproof::model {
/// RapidCheck prints a failing scenario as a file that `simulate` accepts, and a part of one as the
/// JSON of its effective values.
void showValue(const Scenario& scenario, std::ostream& out);
void showValue(const DdsProfile& dds, std::ostream& out);
void showValue(const WirelessProfile& wireless, std::ostream& out);
void showValue(const Deployment& deployment, std::ostream& out);
}  // namespace stormproof::model
