// How well predictions fit measurements: the statistics of the paper's Table IV (coverage and M/O
// among covered runs), and those of a prediction that is a distribution (share of runs within the
// range, calibration of quantiles). specs/guide/coverage.md defines each of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/coverage/configuration.hpp"
#include "checker/evidence/coverage/predict.hpp"
#include "checker/experiments/statistics/quantiles.hpp"

namespace stormproof::prediction {

/// A measured configuration and its prediction. Both must outlive what uses them.
struct Pairing {
  const Configuration* observed = nullptr;
  const Prediction* predicted = nullptr;
};

/// Names of the scopes that occur: "np1", "np2" … by N_P, "nh2", "nh3" … by N_H if it is not the
/// same everywhere, "all", "high_load" (N_P ≥ 4 and N_E ≥ 20), and "spread" (starts that follow one
/// another).
[[nodiscard]] std::vector<std::string> scopes(const std::vector<Pairing>& pairings);
[[nodiscard]] bool in_scope(const Configuration& configuration, const std::string& scope);

using statistics::quantile;

inline constexpr std::size_t calibration_points = 9;  ///< quantiles 0.1 to 0.9

/// One measure in one scope. M of a configuration is the median over its model runs, O the median
/// over its measured runs. What does not exist (no covered run, a median that is infinite) is
/// absent. A configuration with a measured run that did not complete ends at the limit of that run,
/// in the model, too: counts are those up to it, and a completion later than it is unknown on both
/// sides, so that the limit stands for it in a ratio whose other side is known.
struct Fit {
  std::size_t configurations = 0;
  std::size_t runs = 0;             ///< measured
  std::size_t incomplete_runs = 0;  ///< of them; their values are lower bounds
  std::size_t undecided_runs = 0;   ///< of those; lower bound ≤ M, so O ≤ M is open
  std::size_t model_runs = 0;
  std::size_t incomplete_model_runs = 0;
  std::size_t undecided_configurations = 0;  ///< neither M nor O is known; in no ratio

  double coverage = 0;  ///< share of measured runs with O ≤ M; incomplete ones are not covered
  std::optional<double> covered_q1;  ///< of M/O among covered runs
  std::optional<double> covered_median;
  std::optional<double> covered_q3;

  std::optional<double> median_ratio;           ///< over configurations, of M/O
  std::optional<double> median_abs_ln_ratio;    ///< over configurations, of |ln M/O|
  std::optional<double> mean_absolute_percent;  ///< over configurations, of 100 |M − O|/O
  std::size_t percent_configurations = 0;       ///< those for which it is finite

  /// Of what came of a change: share of the measured runs near which the model's comes that has
  /// their own start times (`is_near`), if all of them say these.
  std::optional<double> near;
  double in_range = 0;  ///< share of measured runs between the least and the greatest model run
  /// Share of measured runs that are at most quantile 0.1, 0.2 … 0.9 of the model runs.
  std::array<double, calibration_points> calibration{};
};

/// Nothing if no run of the scope has the measure.
[[nodiscard]] std::optional<Fit> fit(const std::vector<Pairing>& pairings, const std::string& scope,
                                     Measure measure);

/// The measured values of a configuration; of runs that did not complete: infinite, but for counts
/// up to a limit that is known. Runs without this measure are left out.
[[nodiscard]] std::vector<double> observed_values(const Configuration& configuration,
                                                  Measure measure);

}  // namespace stormproof::prediction
