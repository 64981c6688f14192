// `stormproof launch` without its command line: how soon everybody knows everybody under each
// launch plan, with and without the setting that decides about it, and what one more robot costs a
// fleet that runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/launch_plan.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::launch {

struct Request {
  std::string scenario;  ///< as it was given
  std::vector<std::string> overrides;
  model::Nanoseconds limit{60'000'000'000};     ///< what takes longer is not complete
  std::vector<model::Nanoseconds> steps;        ///< of spreads
  std::size_t samples = 5;                      ///< runs of each plan and setting
  std::uint64_t seed = 0;                       ///< run k of each has seed + k
  model::Nanoseconds start_jitter{10'000'000};  ///< each process starts up to this much later
  bool join = false;                            ///< also what one more robot costs
  std::size_t threads = 0;
  trials::StudyProgress on_progress;  ///< false interrupts
};

/// What is set, beside the plan.
struct Setting {
  std::string id;    ///< "as_it_is", "large_send_buffer"
  std::string name;  ///< "as it is", "sendBufferSize 4 MB"
  model::Scenario scenario;
  /// Whether storm.cannot-start is proved for all start times, so of every plan; absent: the
  /// theorem is not about it.
  std::optional<bool> proved;
  std::string why;  ///< of the proof, or why there is none; may be empty
};

/// One plan with one setting.
struct Cell {
  std::vector<trials::Sample> runs;  ///< in the order of their seeds
  statistics::Quantiles completion;  ///< ns from the first start on
  statistics::Quantiles messages;
  std::size_t storms = 0;      ///< runs that are one
  std::size_t incomplete = 0;  ///< runs that are not complete, storms among them

  [[nodiscard]] bool completes() const { return !runs.empty() && completion.max.has_value(); }
};

[[nodiscard]] Cell cell_of(std::vector<trials::Sample> runs);

/// One run of the scenario under a plan; not complete if a wave of it never is; nothing if it was
/// stopped.
[[nodiscard]] std::optional<trials::Sample> sample_plan(trials::Runner& runner,
                                                        const model::Scenario& scenario,
                                                        const Plan& plan, std::uint64_t seed,
                                                        model::Nanoseconds start_jitter);

/// The profile with a send buffer of 4 MB; nothing if it has that already, or no such setting.
[[nodiscard]] std::optional<model::DdsProfile> with_large_send_buffer(model::DdsProfile dds);

struct Row {
  Plan plan;
  std::optional<model::Nanoseconds> last_start;  ///< of the middle run; absent without runs
  std::vector<Cell> cells;                       ///< one for each setting
};

/// A robot more, like the first, when all others know each other and 10 s have passed.
struct Join {
  statistics::Quantiles took;      ///< ns from its start until everybody knows everybody
  statistics::Quantiles messages;  ///< more than without it, until then
  statistics::Quantiles others;    ///< datagrams among them between those who were there
  std::size_t runs = 0;
};

struct Report {
  std::vector<Setting> settings;
  std::vector<Row> rows;     ///< that of the deployed plan first
  std::vector<Join> joins;   ///< one for each setting, if asked for
  bool usual_hosts = false;  ///< the scenario says no hosts, and has the usual ones
  bool interrupted = false;

  struct Place {
    std::size_t row = 0;
    std::size_t setting = 0;
  };
  /// Where all runs complete and the median is least; with `setting`, of it alone. All at once, and
  /// as it is before other settings, if it takes no more than a tenth longer there.
  [[nodiscard]] std::optional<Place> best(std::optional<std::size_t> setting = {}) const;
};

/// Errors: the scenario's, or that it has a life beyond its first starts.
[[nodiscard]] model::config::Result<Report> launch(const Request& request,
                                                   const model::config::SpecPath& specs);

/// The starts of each participant in one run of the plan, ns from the first possible one, as a
/// robot would be told; of plans that wait, as they were in the run of `seed`.
[[nodiscard]] std::vector<model::Nanoseconds> starts_in(const Setting& setting, const Plan& plan,
                                                        const Request& request);

}  // namespace stormproof::launch
