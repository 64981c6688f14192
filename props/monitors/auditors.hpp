// Who audits the runs of each composition, and the monitor that has it done.
#pragma once

#include <memory>

#include "model/implementations.hpp"
#include "props/monitor.hpp"

namespace stormproof::model {
struct RunState;  // model/engine/run_state.hpp
struct Scenario;  // model/scenario.hpp
}  // namespace stormproof::model

namespace stormproof::props {

class Audit;     // props/monitors/audit.hpp
class Follower;  // props/monitors/follower.hpp

using AuditorMaker = std::unique_ptr<Follower> (*)(model::RunState& run, Audit& audit);

/// Of the composition that the scenario's profile names.
[[nodiscard]] std::unique_ptr<Follower> make_auditor(model::RunState& run, Audit& audit);
// Those whose steps are not stated by contracts yet have one of their own.
[[nodiscard]] std::unique_ptr<Follower> auditor_of(model::Of<fsm::composition::cyclone::Cyclone>,
                                                   model::RunState& run, Audit& audit);
[[nodiscard]] std::unique_ptr<Follower> auditor_of(
    model::Of<fsm::composition::server::FastDdsServer>, model::RunState& run, Audit& audit);

/// composition.followed of rules that no profile may name.
[[nodiscard]] std::unique_ptr<Monitor> watch_composition(const model::Scenario& scenario,
                                                         AuditorMaker make);

}  // namespace stormproof::props
