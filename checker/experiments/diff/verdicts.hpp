// The catalogue of properties before and after: `check` on one scenario with each profile.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

struct VerdictRequest {
  std::string name;  ///< of the scenario
  model::Scenario base, candidate;
  std::uint64_t seed = 0;
  std::uint32_t samples = 12;
  std::size_t threads = 0;
  std::function<bool(std::string_view what)> on_progress;  ///< false interrupts
  std::function<bool()> interrupted;                       ///< the same, asked by any thread
};

struct VerdictAnswer {
  VerdictComparison comparison;
  bool interrupted = false;  ///< then nothing is known: `comparison.done` is false
};

[[nodiscard]] VerdictAnswer compare_verdicts(const VerdictRequest& request, const Policy& policy);

/// How the policy judges a change of the answer.
[[nodiscard]] Judgment judge_verdicts(props::VerdictKind before, props::VerdictKind after,
                                      const Policy& policy);

}  // namespace stormproof::diff
