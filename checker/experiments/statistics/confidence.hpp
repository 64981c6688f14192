// How far the rate of a sample may be from the true one.
#pragma once

#include <cstddef>

namespace stormproof::statistics {

inline constexpr double confidence_level = 0.95;

/// An interval that contains the true rate with at least the confidence that was asked for.
struct RateInterval {
  double low = 0;
  double high = 1;
};

/// The exact interval of Clopper and Pearson: `low` and `high` are the rates under which `hits` or
/// more, or `hits` or fewer, of `runs` independent runs have probability (1 - level)/2. 0 of n
/// gives [0, 1 - ((1 - level)/2)^(1/n)]. No runs: [0, 1].
[[nodiscard]] RateInterval clopper_pearson(std::size_t hits, std::size_t runs,
                                           double level = confidence_level);

}  // namespace stormproof::statistics
