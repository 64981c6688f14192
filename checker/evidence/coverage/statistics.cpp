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
    const std::vector<double> model = sorted(pairing.predicted->values[measure_]);
    if (observed.empty() || model.empty()) return;
    const double prediction = quantile(model, 0.5);
    ++fit_.configurations;
    fit_.model_runs += model.size();
    fit_.incomplete_model_runs += pairing.predicted->incomplete;
    const std::optional<double> limit = is_completion() ? pairing.observed->limit() : std::nullopt;
    add_configuration(prediction, quantile(observed, 0.5), limit.value_or(unreached));
    add_runs(observed, model, prediction);
    add_own(pairing, observed);
    const bool is_held = pairing.observed->limit().has_value() && !is_completion();
    for (const Observation& run : pairing.observed->runs) {
      if (run.completed || !run.values[measure_]) continue;
      ++fit_.incomplete_runs;
      if (!is_held && *run.values[measure_] <= prediction) ++fit_.undecided_runs;
    }
  }

  [[nodiscard]] std::optional<Fit> finish() {
    if (fit_.runs == 0) return std::nullopt;
    fit_.coverage = share(fit_.coverage, fit_.runs);
    fit_.in_range = share(fit_.in_range, fit_.runs);
    if (own_runs_ > 0) fit_.near = share(static_cast<double>(near_), own_runs_);
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
  [[nodiscard]] bool is_completion() const {
    return static_cast<Measure>(measure_) == Measure::completion;
  }

  /// `limit`: what is known of either if it is infinite; infinite itself if nothing is.
  void add_configuration(double model, double observed, double limit) {
    if (std::isinf(model) && std::isinf(observed)) {
      ++fit_.undecided_configurations;
      return;
    }
    const bool both_known = std::isfinite(model) && std::isfinite(observed);
    const auto known = [limit](double value) { return std::isinf(value) ? limit : value; };
    const double ratio = std::isinf(known(observed)) ? 0 : ratio_of(known(model), known(observed));
    ratios_.push_back(ratio);
    const double percent = 100 * std::abs(ratio - 1);
    if (std::isfinite(percent) && both_known) percents_.push_back(percent);
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

  /// Each measured run beside the one of the model that starts as it did.
  void add_own(const Pairing& pairing, const std::vector<double>& observed) {
    const std::vector<double>& model = pairing.predicted->values[measure_];
    if (measure_ < statistics::common_measure_count) return;
    if (pairing.predicted->own != observed.size() || model.size() < observed.size()) return;
    own_runs_ += observed.size();
    for (std::size_t k = 0; k < observed.size(); ++k) {
      if (is_near(static_cast<Measure>(measure_), model[k], observed[k])) ++near_;
    }
  }

  std::size_t own_runs_ = 0;
  std::size_t near_ = 0;
  std::size_t measure_;
  Fit fit_;  ///< until `finish`, shares are sums
  std::vector<double> covered_;
  std::vector<double> ratios_;
  std::vector<double> percents_;
};

}  // namespace

std::vector<std::string> scopes(const std::vector<Pairing>& pairings) {
  std::set<std::uint32_t> participants;
  std::set<std::uint32_t> hosts;
  for (const Pairing& pairing : pairings) {
    participants.insert(pairing.observed->participants_per_host);
    hosts.insert(pairing.observed->hosts);
  }
  std::vector<std::string> names;
  for (const std::uint32_t n : participants) names.push_back(fmt::format("np{}", n));
  if (hosts.size() > 1) {
    for (const std::uint32_t n : hosts) names.push_back(fmt::format("nh{}", n));
  }
  names.emplace_back("all");
  for (const char* const name : {"high_load", "spread"}) {
    const auto occurs = [name](const Pairing& one) { return in_scope(*one.observed, name); };
    if (std::ranges::any_of(pairings, occurs)) names.emplace_back(name);
  }
  return names;
}

bool in_scope(const Configuration& configuration, const std::string& scope) {
  if (scope == "all") return true;
  if (scope == "high_load") {
    return configuration.participants_per_host >= 4 && configuration.endpoints >= 20;
  }
  if (scope == "spread") return configuration.spread.step_ms > 0;
  return scope == fmt::format("np{}", configuration.participants_per_host) ||
         scope == fmt::format("nh{}", configuration.hosts);
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
  const bool is_held = measure != Measure::completion && configuration.limit();
  for (const Observation& run : configuration.runs) {
    const auto& value = run.values[static_cast<std::size_t>(measure)];
    if (value) values.push_back(run.completed || is_held ? *value : unreached);
  }
  return values;
}

}  // namespace stormproof::prediction
