// What an intervention does: the ratio of a changed system to its baseline, predicted and, where
// both were measured, observed, with bootstrap intervals.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/coverage/statistics.hpp"

namespace stormproof::prediction {

/// One deployment with and without the intervention.
struct Contrast {
  Pairing changed;
  Pairing baseline;
};

/// A median over configurations with the 90 % interval of 2,000 bootstrap draws.
struct RatioEstimate {
  std::size_t configurations = 0;
  double median = 0;  ///< infinite if the changed system mostly does not complete
  double low = 0;
  double high = 0;
};

/// Each interval lies below 1, above 1, or contains it (no effect). `confirmed`: both the same, and
/// the intervals overlap. `direction_only`: the same, but they do not. `open`: not the same, but
/// they overlap, so the measurement allows both. `refuted`: neither.
enum class EffectVerdict { confirmed, direction_only, open, refuted, not_measured };
[[nodiscard]] const char* name_of(EffectVerdict verdict);

struct Effect {
  std::string scope;
  Measure measure{};
  RatioEstimate predicted;
  std::optional<RatioEstimate> observed;
  EffectVerdict verdict = EffectVerdict::not_measured;
};

/// Contrasts of equal deployments, in the order of `changed`; those without partner are left out.
[[nodiscard]] std::vector<Contrast> contrasts(const std::vector<Pairing>& changed,
                                              const std::vector<Pairing>& baseline);

/// The effect in a scope; nothing if no configuration of it has the measure. `measured`: the runs
/// of `changed` were measured, not only those of the baseline.
[[nodiscard]] std::optional<Effect> effect(const std::vector<Contrast>& contrasts,
                                           const std::string& scope, Measure measure,
                                           bool measured);

}  // namespace stormproof::prediction
