// The answer of `stormproof launch`: a document, JSON, a curve, and what a robot runs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/launch/launch.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::launch {

[[nodiscard]] report::Document document_of(const Report& report, const Request& request,
                                           const std::vector<std::string>& written);
/// specs/guide/launch.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report, const Request& request,
                                             const std::vector<std::string>& written);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

/// Completion over the step of the spread, with the range of the runs.
[[nodiscard]] std::string to_svg(const Report& report);

/// What a robot runs to start as the plan says.
struct LaunchFile {
  std::string name;
  std::string text;
};
/// For each host a ROS 2 launch file, and for each of its processes a systemd unit; nothing if the
/// starts of the plan are not known.
[[nodiscard]] std::vector<LaunchFile> launch_files(const Setting& setting, const Plan& plan,
                                                   const Request& request);
/// The same of a plan that another verb has found. `what` is set beside it, `named` is the scenario
/// as it was given, and `seed` draws its starts.
[[nodiscard]] std::vector<LaunchFile> launch_files(const std::string& what,
                                                   const model::Scenario& scenario,
                                                   const Plan& plan, const std::string& named,
                                                   std::uint64_t seed);

}  // namespace stormproof::launch
