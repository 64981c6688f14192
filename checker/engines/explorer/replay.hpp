// A path of the explorer becomes a scenario, and the simulator decides: a counterexample counts
// only if the property's monitor objects in a run of the simulator. The scenario has a host with
// one participant for the writer and for each reader, constant delay, and the path's delay or loss
// for each packet of the relations. A packet's number is known only once everything before it has
// been emitted, so the simulator runs again and again until each packet of the path has its delay.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "checker/engines/explorer/path.hpp"
#include "model/engine/packet.hpp"
#include "model/probe.hpp"
#include "model/run_result.hpp"
#include "props/verdict.hpp"

namespace stormproof::model {
struct ImplementationMaker;  // model/engine/implementation_maker.hpp
}  // namespace stormproof::model

namespace stormproof::explorer {

struct ReplayRequest {
  const model::Scenario& running;        ///< whose profile runs
  const model::Scenario& specification;  ///< what the monitor holds the run against
  const model::Mutation* mutation = nullptr;
  const Scope& scope;
  Bounds bounds;
  /// Who executes the rules, if not the implementation that the profile names.
  const model::ImplementationMaker* maker = nullptr;
};

/// Whether a packet of a run is one of the explored relations, the first ones of participant 0; and
/// of which of them, with the reader to or from which it goes.
[[nodiscard]] inline bool is_explored(const model::Packet& packet, const Scope& scope) {
  return packet.pair < scope.readers && index_of(packet.stream) < scope.writers;
}
[[nodiscard]] inline std::uint32_t explored_relation(const model::Packet& packet,
                                                     std::uint32_t reader, const Scope& scope) {
  return scope.writers * reader + static_cast<std::uint32_t>(index_of(packet.stream));
}

struct ReplayOutcome {
  std::optional<props::Counterexample> counterexample;
  std::string why_not;  ///< one sentence; empty if there is a counterexample
};

/// The simulator's run of a scenario of a path.
model::RunResult run(const ReplayRequest& request, const model::Scenario& scenario,
                     model::Probe& probe);

[[nodiscard]] ReplayOutcome replay(const ReplayRequest& request, const ConcretePath& path,
                                   std::string_view property);

/// When the explored world starts, in the time of the run.
[[nodiscard]] model::Nanoseconds start_of_world(const ReplayRequest& request,
                                                const ConcretePath& path);

/// The scenario of the path, with the delay of every packet of the path; or why there is none.
[[nodiscard]] std::optional<model::Scenario> scenario_of(const ReplayRequest& request,
                                                         const ConcretePath& path,
                                                         std::string& why_not);

}  // namespace stormproof::explorer
