// What happened in a measured run beside its start: the network went and came back, or a process
// was killed or left, and perhaps another one came in its place. How a row says it, the life of the
// participants that the model gives it, and what is compared of both: how long recovery takes, who
// forgets whom, and what is sent before, during and after.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "checker/experiments/statistics/measure.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::prediction {

struct Observation;
class Row;

/// Earliest and latest of one run's participants, or the first and the last instant of something,
/// in ms since the common start.
struct Range {
  double low = 0;
  double high = 0;

  auto operator<=>(const Range&) const = default;
};

/// A process that went; ms since the common start.
struct Departure {
  std::uint32_t host = 0;
  std::uint32_t id = 0;  ///< 0 to N_P − 1
  bool says_so = false;  ///< it left; otherwise it was killed
  double at = 0;
  double planned_return = 0;        ///< when the new process was to be started; 0: none
  std::optional<double> back = {};  ///< when the new one announced itself

  auto operator<=>(const Departure&) const = default;
};

struct Change {
  std::optional<Range> outage;
  std::optional<std::uint32_t> cut_off;  ///< this host alone; nobody in particular: all hosts
  std::optional<Departure> departure;

  [[nodiscard]] bool happens() const { return outage || departure; }
  /// When it begins, and when it is over and recovery begins, ms.
  [[nodiscard]] double begins() const { return outage ? outage->low : over(); }
  [[nodiscard]] double over() const {
    return outage ? outage->high : departure ? departure->at : 0;
  }
  auto operator<=>(const Change&) const = default;
};

/// Reads `outage_ms`, `outage_scope` and `leave`, and what was measured of it: `recovery_ms`,
/// `lost_pairs` and `phases`.
void read_change(Row& row, Observation& run);

/// The life of the participants of the scenario, of which so many are on each host.
void put(const Change& change, std::uint32_t participants_per_host, model::Scenario& scenario);

/// What the model says of a run in which this happens, by measure; of others nothing.
using MeasureValues = std::array<std::optional<double>, statistics::measure_count>;
struct ChangedRun {
  model::RunResult whole;        ///< until everybody has everything again
  model::RunResult undisturbed;  ///< as if nothing changed, until discovery is complete
  model::Counts until_begun;     ///< of the whole until the change begins,
  model::Counts until_over;      ///< and until it is over

  /// Discovery was complete for the first time: before the change, or, if that begins earlier, when
  /// all was over. Nothing if it never was.
  [[nodiscard]] std::optional<model::Nanoseconds> first_completion(const Change& change) const;
  /// What had been sent by then.
  [[nodiscard]] const model::Counts& sent_at_first(const Change& change) const;
};
/// Runs the scenario with the life that `put` gave it; nothing if it was stopped.
[[nodiscard]] std::optional<ChangedRun> run_changed(trials::Runner& runner, const Change& change,
                                                    const model::Scenario& scenario);
void add_values(const Change& change, const ChangedRun& run, MeasureValues& values);

/// Whether a prediction is near what was measured: who forgets whom exactly, recovery within a
/// factor of 1.25 or 0.3 s, messages within that factor.
[[nodiscard]] bool is_near(statistics::Measure measure, double predicted, double measured);

}  // namespace stormproof::prediction
