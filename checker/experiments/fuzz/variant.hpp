// Variants: scenarios drawn from ranges around the user's. Each depends only on the scenario, the
// ranges, the seed and its number, and is the same on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/experiments/fuzz/ranges.hpp"
#include "model/scenario.hpp"

namespace stormproof::fuzz {

struct Variant {
  model::Scenario scenario;    ///< valid; loses what the base loses
  std::uint32_t rejected = 0;  ///< draws before it that gave no valid scenario
};

class VariantSource {
 public:
  static constexpr std::uint32_t most_draws = 1'000;

  VariantSource(const model::Scenario& base, const Ranges& ranges);

  /// Variant `number` of `seed`; nothing if none of `most_draws` draws is a valid scenario. It has
  /// the limits of the base, neither its `vary` nor its schedule: the drawn times remain.
  [[nodiscard]] std::optional<Variant> draw(std::uint64_t seed, std::uint64_t number) const;

  /// Those of the first `packets` packets of variant `number` that the ranges lose, ascending. The
  /// answer for fewer packets is the beginning of that for more.
  [[nodiscard]] std::vector<std::uint64_t> losses(std::uint64_t seed, std::uint64_t number,
                                                  std::uint64_t packets) const;

 private:
  const model::Scenario& base_;
  const Ranges& ranges_;
  std::vector<KnobRange> knobs_;     ///< relative ranges made absolute, then the stated ones
  std::optional<KnobRange> spread_;  ///< of the starts
};

}  // namespace stormproof::fuzz
