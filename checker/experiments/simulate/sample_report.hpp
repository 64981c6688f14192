// The answer of `stormproof simulate --samples N` and `--compare`: distributions over sampled
// schedules, one profile or several side by side on the same schedules.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::report {

/// All runs of one DDS profile.
struct SampledProfile {
  std::string name;
  model::Scenario scenario;
  std::vector<trials::Sample> samples;
};

struct Sampling {
  std::string name;        ///< what the user called the scenario
  std::size_t wanted = 0;  ///< samples asked for; fewer exist if the runs were interrupted
  std::uint64_t first_seed = 0;
  model::Nanoseconds start_jitter{};     ///< each participant starts up to this much later
  std::vector<SampledProfile> profiles;  ///< the scenario's own first, then those to compare with
  std::string words = name;              ///< the scenario with its overrides, for a command line

  /// Whether the runs of a scenario differ.
  [[nodiscard]] bool is_drawn(const model::Scenario& scenario) const {
    return model::is_drawn(scenario) || start_jitter.count() > 0;
  }
};

/// Statistics of one profile.
struct SampleSummary {
  std::size_t runs = 0;
  std::size_t completed = 0;
  statistics::Quantiles discovery_time_ns;
  std::array<statistics::Quantiles, model::message_class_count> counts;  ///< by class
  statistics::Quantiles total;
  statistics::Quantiles user_control;
  statistics::Quantiles lookup;
};
[[nodiscard]] SampleSummary summarize(const std::vector<trials::Sample>& samples);

[[nodiscard]] Document document_of(const Sampling& sampling);

/// Keys: scenario, seed, wanted, samples (array of runs), summary, profile; with several
/// profiles also compare, an array of {profile_name, samples, summary, profile}.
/// specs/guide/output.md describes them.
[[nodiscard]] nlohmann::ordered_json to_json(const Sampling& sampling);
[[nodiscard]] nlohmann::ordered_json sampling_schema(SchemaDefinitions& definitions);

}  // namespace stormproof::report
