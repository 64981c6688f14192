// The answer of `stormproof simulate`: one run beside what it is compared with, as a document and
// as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/counts.hpp"
#include "model/nodes.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "props/limits.hpp"

namespace stormproof::report {

struct Simulation {
  std::string name;  ///< what the user called the scenario
  model::Scenario scenario;
  model::RunResult result;
  model::Counts failure_free;
  std::optional<model::Nanoseconds> open_loop;
  std::vector<props::LimitReading> limits = {};  ///< those that the scenario sets
  std::vector<trials::Sample> samples = {};      ///< other draws of its schedule, if it has one
  std::string words = name;                      ///< with the overrides, for a command line

  /// Of all samples, or of the one run.
  [[nodiscard]] exact::Outlook outlook() const;
  /// The least that the last `ros_discovery_info` has, if it does not fit into one frame.
  [[nodiscard]] std::optional<model::Bytes> fragmented_graph_info() const;
};

/// Completes a run with its reference and its baseline.
[[nodiscard]] Simulation describe(std::string name, const model::Scenario& scenario,
                                  model::RunResult result);

/// For a person who knows ROS 2 but not this project.
[[nodiscard]] Document document_of(const Simulation& simulation);

/// Keys: scenario, outlook, completed, end, t_disc_ns, ros_discovery_info_bytes (if it is more than
/// a frame), end_ns, counts, failure_free, amplification,
/// events, open_loop_ns, closed_to_open_loop, limits (if the scenario has any), missing, channels,
/// backlog, latency, deliveries, last_delivery, profile. specs/guide/output.md describes them.
[[nodiscard]] nlohmann::ordered_json to_json(const Simulation& simulation);
[[nodiscard]] nlohmann::ordered_json simulation_schema(SchemaDefinitions& definitions);

}  // namespace stormproof::report
