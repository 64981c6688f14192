// Runs the plan on all cores, as many draws as decide the figures, and keeps what the report needs
// of each run.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "checker/experiments/reproduce/plan.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "model/counts.hpp"
#include "model/run_result.hpp"

namespace stormproof::reproduce {

/// What is kept of one simulator run.
struct Run {
  model::RunEnd end{};
  std::optional<model::Nanoseconds> completion;
  model::Counts counts;
};

/// The message classes of the report: those of the model, and what the paper's tables have beside
/// them.
enum class Class : std::uint8_t {
  initial_data,
  repair_data,
  heartbeat,
  acknack,
  spdp_multicast,
  spdp_unicast,
  spdp,  ///< both kinds in one
  total
};
inline constexpr std::array<Class, 6> table_classes{Class::spdp,        Class::initial_data,
                                                    Class::repair_data, Class::heartbeat,
                                                    Class::acknack,     Class::total};
[[nodiscard]] const char* name_of(Class one);
[[nodiscard]] std::uint64_t count_of(const model::Counts& counts, Class one);

/// All runs of one case. A mean with a run that did not complete does not exist: its completion is
/// unreached, and its messages are only those up to the limit.
struct Outcome {
  std::vector<Run> runs;

  [[nodiscard]] std::size_t completed() const;
  [[nodiscard]] std::optional<double> completion_s() const;
  [[nodiscard]] std::optional<double> fastest_s() const;
  [[nodiscard]] std::optional<double> slowest_s() const;
  [[nodiscard]] std::optional<double> messages(Class one) const;
};

struct Results {
  Plan plan;
  std::map<Case, Outcome> outcomes;  ///< a case whose first runs were interrupted is not in it
  bool complete = false;             ///< whether every case is there
  /// Processor time of the paper's own evaluation: its profile on Wi-Fi, periodic HEARTBEATs.
  double evaluation_cpu_s = 0;
  double total_cpu_s = 0;
  std::size_t runs = 0;  ///< that finished

  /// Nothing if the plan has no such case, or it was interrupted.
  [[nodiscard]] const Outcome* find(const Case& one) const;
  /// The case that most of the report is about: periodic, first order of service.
  [[nodiscard]] const Outcome* find(std::size_t variant, Network network,
                                    const Configuration& configuration) const;
};

struct RunLimits {
  std::size_t threads = 0;  ///< 0: one for each core
  /// With it, configurations with drawn start times get no more draws than decide its figures
  /// (decided.hpp); without it all of them.
  const Published* published = nullptr;
  trials::Progress on_progress{};
};

[[nodiscard]] Results run(const Plan& plan, const RunLimits& limits = {});

}  // namespace stormproof::reproduce
