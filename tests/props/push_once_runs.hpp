// Runs of a composition that nothing but tests knows (tests/model/push_once), and who audits them.
#pragma once

#include <memory>

#include "model/mutation.hpp"
#include "model/probe.hpp"
#include "model/scenario.hpp"
#include "props/monitor.hpp"

namespace stormproof::props {

void run_push_once(const model::Scenario& scenario, model::Probe& probe,
                   const model::Mutation* mutation = nullptr);
/// composition.followed of these runs.
[[nodiscard]] std::unique_ptr<Monitor> watch_push_once(const model::Scenario& scenario);

}  // namespace stormproof::props
