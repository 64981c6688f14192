// The bootstrap draws configurations, and within each of them runs, with replacement: both the
// choice of configurations and the spread of storms are in the interval.
#include "checker/evidence/coverage/effect.hpp"

#include <cmath>
#include <limits>
#include <random>

namespace stormproof::prediction {

namespace {

/// Values of one configuration with and without the intervention.
struct Samples {
  std::vector<double> changed;
  std::vector<double> baseline;
};

/// Ratio of medians: 1 if both are 0 or neither completes.
double ratio_of_medians(const Samples& samples) {
  const double changed = quantile(samples.changed, 0.5);
  const double baseline = quantile(samples.baseline, 0.5);
  if (changed == baseline) return 1;
  if (baseline == 0) return std::numeric_limits<double>::infinity();
  return std::isinf(baseline) ? 0 : changed / baseline;
}

RatioEstimate estimate(const std::vector<Samples>& configurations) {
  constexpr std::size_t draws = 2'000;
  std::mt19937_64 random{20'260'101};  // any fixed seed: the same intervals in every run
  const auto redraw = [&random](const std::vector<double>& values) {
    std::vector<double> drawn;
    for (std::size_t k = 0; k < values.size(); ++k)
      drawn.push_back(values[random() % values.size()]);
    return drawn;
  };
  std::vector<double> ratios;
  for (const Samples& samples : configurations) ratios.push_back(ratio_of_medians(samples));
  std::vector<double> medians;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    std::vector<double> drawn;
    for (std::size_t k = 0; k < configurations.size(); ++k) {
      const Samples& samples = configurations[random() % configurations.size()];
      drawn.push_back(ratio_of_medians({redraw(samples.changed), redraw(samples.baseline)}));
    }
    medians.push_back(quantile(drawn, 0.5));
  }
  return {configurations.size(), quantile(ratios, 0.5), quantile(medians, 0.05),
          quantile(medians, 0.95)};
}

/// -1: less, 1: more, 0: the interval contains "no change".
int direction(const RatioEstimate& ratio) { return ratio.high < 1 ? -1 : ratio.low > 1 ? 1 : 0; }

EffectVerdict judge(const RatioEstimate& predicted, const RatioEstimate& observed) {
  const bool overlap = predicted.low <= observed.high && observed.low <= predicted.high;
  if (direction(predicted) == direction(observed)) {
    return overlap ? EffectVerdict::confirmed : EffectVerdict::direction_only;
  }
  return overlap ? EffectVerdict::open : EffectVerdict::refuted;
}

}  // namespace

const char* name_of(EffectVerdict verdict) {
  constexpr const char* names[] = {"confirmed", "direction only", "open", "refuted",
                                   "not measured"};
  return names[static_cast<std::size_t>(verdict)];
}

std::vector<Contrast> contrasts(const std::vector<Pairing>& changed,
                                const std::vector<Pairing>& baseline) {
  std::vector<Contrast> result;
  for (const Pairing& one : changed) {
    for (const Pairing& other : baseline) {
      if (one.observed->same_deployment(*other.observed)) result.push_back({one, other});
    }
  }
  return result;
}

std::optional<Effect> effect(const std::vector<Contrast>& contrasts, const std::string& scope,
                             Measure measure, bool measured) {
  std::vector<Samples> predicted;
  std::vector<Samples> observed;
  const auto m = static_cast<std::size_t>(measure);
  for (const Contrast& contrast : contrasts) {
    if (!in_scope(*contrast.changed.observed, scope)) continue;
    Samples model{contrast.changed.predicted->values[m], contrast.baseline.predicted->values[m]};
    if (model.changed.empty() || model.baseline.empty()) continue;  // runs do not have it
    predicted.push_back(std::move(model));
    if (!measured) continue;
    Samples runs{observed_values(*contrast.changed.observed, measure),
                 observed_values(*contrast.baseline.observed, measure)};
    if (!runs.changed.empty() && !runs.baseline.empty()) observed.push_back(std::move(runs));
  }
  if (predicted.empty()) return std::nullopt;
  Effect result;
  result.scope = scope;
  result.measure = measure;
  result.predicted = estimate(predicted);
  if (!observed.empty()) {
    result.observed = estimate(observed);
    result.verdict = judge(result.predicted, *result.observed);
  }
  return result;
}

}  // namespace stormproof::prediction
