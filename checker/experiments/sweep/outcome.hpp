// What a sweep keeps of one run. One list of names serves the database, the CSV and JSON tables and
// the messages between ranks; the names are those of `simulate --format json`.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::sweep {

/// The numbers of a run, in the order of the tables. Times in ns; counts of messages when they are
/// generated; `missing` descriptor deliveries; `peak_backlog` packets of the participant that had
/// most.
inline constexpr std::array<const char*, 16> number_names{
    "t_disc_ns",    "initial_data",   "repair_data",  "heartbeat",
    "acknack",      "spdp_multicast", "spdp_unicast", "total",
    "user_control", "lookup",         "end_ns",       "events",
    "missing",      "peak_backlog",   "open_loop_ns", "failure_free_total",
};
inline constexpr std::size_t first_count = 1, end_of_counts = 8;  ///< in `number_names`

struct Outcome {
  /// "completed", "time_limit", "no_more_events", or "error" with `error`.
  std::string end;
  std::string error;
  std::array<std::optional<std::int64_t>, number_names.size()> numbers{};
  double wall_seconds = 0;  ///< of the simulation and its open-loop baseline
  double cpu_seconds = 0;   ///< the same, of the thread that ran it

  /// Whether discovery was completed, whatever ended the run.
  [[nodiscard]] bool completed() const { return numbers.front().has_value(); }
  [[nodiscard]] bool failed() const { return end == "error"; }
};

/// The outcome of a job that cannot run.
[[nodiscard]] Outcome failure(std::string error);

/// Simulates. `stop` is asked now and then; if it returns true there is no outcome. Memory that
/// does not suffice is an outcome with an error.
[[nodiscard]] std::optional<Outcome> run(const model::Scenario& scenario,
                                         const std::function<bool()>& stop);

}  // namespace stormproof::sweep
