// `stormproof compare-discovery` without its command line: the ways to discover side by side, on
// the same start times, as the deployment grows; where each of them breaks; and how far what is
// said of each was held against live runs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/experiments/compare/candidates.hpp"
#include "checker/experiments/compare/validated.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/experiments/tune/tune.hpp"

namespace stormproof::compare {

/// What is shown of a run. All announcements are one figure: those of a Discovery Server are
/// reliable, with HEARTBEATs and ACKNACKs of their own.
enum class Figure : std::uint8_t {
  completion,
  messages,
  initial_data,
  repair_data,
  heartbeat,
  acknack,
  announcements,
  user_control
};
inline constexpr std::size_t figure_count = 8;
/// "t_disc_ns", "messages", …, for data.
[[nodiscard]] const char* key_of(Figure figure);
/// "completion", "messages", "initial DATA", …, for people.
[[nodiscard]] const char* words_of(Figure figure);

/// One candidate at one size.
struct Cell {
  std::uint32_t size = 0;
  std::vector<trials::Sample> runs;  ///< in the order of their seeds
  std::array<statistics::Quantiles, figure_count> figures;
  std::size_t completed = 0;
  std::string outcome;       ///< "FINE", "STORM in 4 of 5 runs", …; empty: no runs
  exact::Health health{};    ///< of the middle run; only if there are runs
  bool breaks = false;       ///< half of the runs storm, or miss the limit
  std::string not_run;       ///< why there are no runs; empty: there are
  bool interrupted = false;  ///< it has not all runs that it was to have
};

struct Row {
  Candidate candidate;
  std::vector<Cell> cells;                 ///< one for each size
  std::optional<std::uint32_t> breaks_at;  ///< the least size that was run and breaks
  std::vector<std::string> files;          ///< written, to deploy it
};

struct Request {
  std::string scenario;  ///< as it was given
  std::vector<std::string> overrides;
  Grows grows = Grows::robots;
  std::vector<std::uint32_t> sizes;  ///< empty: the usual ones; the own size is always among them
  std::size_t samples = 5;           ///< of each cell, if runs differ
  std::uint64_t seed = 0;
  model::Nanoseconds start_jitter{};
  model::Nanoseconds limit{};   ///< of a run; 0: the scenario's, but not above `longest`
  std::size_t tune_budget = 0;  ///< runs of a search for settings; 0: none
  std::size_t threads = 0;
  trials::StudyProgress on_progress;  ///< false interrupts
};

/// Runs of storms take long, and say nothing new by it.
inline constexpr model::Nanoseconds longest{20'000'000'000};

struct Report {
  Candidates candidates;
  Grows grows{};
  std::vector<std::uint32_t> sizes;  ///< ascending
  std::uint32_t own_size = 0;
  std::size_t samples = 0;  ///< of each cell
  bool is_sampled = false;
  model::Nanoseconds limit;
  std::vector<Row> rows;
  Validated validated;
  bool interrupted = false;

  [[nodiscard]] std::size_t own_index() const;  ///< in `sizes`
};

/// Why there are no runs of what was not finished.
inline constexpr const char* interrupted = "interrupted";

/// Settings of the scenario's library that a search finds, as one more candidate; what it finds
/// none for says so (`skipped`).
[[nodiscard]] model::config::Result<Candidate> tuned_candidate(
    const Candidates& all, const std::string& reference, std::span<const std::string> overrides,
    const tune::Options& options, const model::config::SpecPath& specs);

/// Errors: the scenario's, a jitter or sizes that it cannot have.
[[nodiscard]] model::config::Result<Report> compare(const Request& request,
                                                    const model::config::SpecPath& specs);

}  // namespace stormproof::compare
