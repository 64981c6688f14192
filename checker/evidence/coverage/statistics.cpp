// The statistics. A run that did not complete is above every limit, so order statistics stay exact,
// and no run is dropped.
#include "checker/evidence/coverage/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Core>
#include <fmt/core.h>

namespace stormproof::prediction {

namespace {

using statistics::unreached;

std::vector<double> sorted(std::vector<double> values) {
  std::ranges::sort(values);
  return values;
}

Eigen::Map<const Eigen::ArrayXd> array(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional{value} : std::nullopt;
}

std::optional<double> finite_quantile(const std::vector<double>& values, double q) {
  return values.empty() ? std::nullopt : if_finite(quantile(values, q));
}

/// M/O: 1 if both are 0, infinite if only O is.
double ratio_of(double model, double observed) {
  if (model == observed) return 1;
  return observed == 0 ? unreached : model / observed;
}

double share(double part, std::size_t whole) { return part / static_cast<double>(whole); }

/// Collects the runs and configurations of one scope.
class Collection {
 public:
  explicit Collection(Measure measure) : measure_{static_cast<std::size_t>(measure)} {}

  void add(const Pairing& pairing) {
    const std::vector<double> observed =
        observed_values(*pairing.observed, static_cast<Measure>(measure_));
    if (observed.empty()) return;
    const std::vector<double> model = sorted(pairing.predicted->values[measure_]);
    const double prediction = quantile(model, 0.5);
    ++fit_.configurations;
    fit_.model_runs += model.size();
    fit_.incomplete_model_runs += pairing.predicted->incomplete;
    add_configuration(prediction, quantile(observed, 0.5));
    add_runs(observed, model, prediction);
    for (const Observation& run : pairing.observed->runs) {
      if (run.completed || !run.values[measure_]) continue;
      ++fit_.incomplete_runs;
      if (*run.values[measure_] <= prediction) ++fit_.undecided_runs;
    }
  }

  [[nodiscard]] std::optional<Fit> finish() {
    if (fit_.runs == 0) return std::nullopt;
    fit_.coverage = share(fit_.coverage, fit_.runs);
    fit_.in_range = share(fit_.in_range, fit_.runs);
    for (double& below : fit_.calibration) below = share(below, fit_.runs);
    fit_.covered_q1 = finite_quantile(covered_, 0.25);
    fit_.covered_median = finite_quantile(covered_, 0.5);
    fit_.covered_q3 = finite_quantile(covered_, 0.75);
    fit_.median_ratio = finite_quantile(ratios_, 0.5);
    const Eigen::ArrayXd distances = array(ratios_).log().abs();
    fit_.median_abs_ln_ratio = finite_quantile({distances.begin(), distances.end()}, 0.5);
    fit_.percent_configurations = percents_.size();
    if (!percents_.empty()) fit_.mean_absolute_percent = array(percents_).mean();
    return fit_;
  }

 private:
  void add_configuration(double model, double observed) {
    if (std::isinf(model) && std::isinf(observed)) {
      ++fit_.undecided_configurations;
      return;
    }
    const double ratio = std::isinf(observed) ? 0 : ratio_of(model, observed);
    ratios_.push_back(ratio);
    const double percent = 100 * std::abs(ratio - 1);
    if (std::isfinite(percent) && std::isfinite(observed)) percents_.push_back(percent);
  }

  /// `model` ascends.
  void add_runs(const std::vector<double>& observed, const std::vector<double>& model,
                double prediction) {
    fit_.runs += observed.size();
    for (const double run : observed) {
      if (run <= prediction && run < unreached) {
        ++fit_.coverage;
        covered_.push_back(ratio_of(prediction, run));
      }
      if (run >= model.front() && run <= model.back()) ++fit_.in_range;
      for (std::size_t k = 0; k < calibration_points; ++k) {
        const double limit = statistics::quantile_of_sorted(model, static_cast<double>(k + 1) / 10);
        if (run <= limit) ++fit_.calibration[k];
      }
    }
  }

  std::size_t measure_;
  Fit fit_;  ///< until `finish`, shares are sums
  std::vector<double> covered_;
  std::vector<double> ratios_;
  std::vector<double> percents_;
};

}  // namespace

std::vector<std::string> scopes(const std::vector<Pairing>& pairings) {
  std::set<std::uint32_t> participants;
  bool high_load = false;
  for (const Pairing& pairing : pairings) {
    participants.insert(pairing.observed->participants_per_host);
    high_load = high_load || in_scope(*pairing.observed, "high_load");
  }
  std::vector<std::string> names;
  for (const std::uint32_t n : participants) names.push_back(fmt::format("np{}", n));
  names.emplace_back("all");
  if (high_load) names.emplace_back("high_load");
  return names;
}

bool in_scope(const Configuration& configuration, const std::string& scope) {
  if (scope == "all") return true;
  if (scope == "high_load") {
    return configuration.participants_per_host >= 4 && configuration.endpoints >= 20;
  }
  return scope == fmt::format("np{}", configuration.participants_per_host);
}

std::optional<Fit> fit(const std::vector<Pairing>& pairings, const std::string& scope,
                       Measure measure) {
  Collection collection{measure};
  for (const Pairing& pairing : pairings) {
    if (in_scope(*pairing.observed, scope)) collection.add(pairing);
  }
  return collection.finish();
}

std::vector<double> observed_values(const Configuration& configuration, Measure measure) {
  std::vector<double> values;
  for (const Observation& run : configuration.runs) {
    const auto& value = run.values[static_cast<std::size_t>(measure)];
    if (value) values.push_back(run.completed ? *value : unreached);
  }
  return values;
}

}  // namespace stormproof::prediction
