// Two costs without a common currency: discovery can be shortened by sending more, and sending can
// be saved by waiting. So settings are compared by dominance (no worse in both, better in one), and
// what is worth showing is the Pareto front: the settings that no other one dominates. Ranks and
// crowding are those of NSGA-II (Deb et al. 2002).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stormproof::tune {

/// What a setting costs; less is better. None is NaN.
struct Cost {
  double completion = 0;  ///< ns; infinite: mostly not reached
  double messages = 0;
  /// Of a completion that is not reached: the share of the descriptors that is missing. It is no
  /// time, but tells a search which of two such settings is nearer to one.
  double missing = 0;

  bool operator==(const Cost&) const = default;
};

/// Whether `a` completes sooner, or misses less where neither does.
[[nodiscard]] bool is_sooner(const Cost& a, const Cost& b);

/// Whether `a` costs no more than `b` in either, and less in one.
[[nodiscard]] bool dominates(const Cost& a, const Cost& b);

/// Positions of the costs that no other one dominates, by completion; of equal ones the first.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const Cost> costs);

/// For each cost how many fronts have to be taken away before it is on one.
[[nodiscard]] std::vector<std::size_t> pareto_ranks(std::span<const Cost> costs);

/// All positions, those first that are worth keeping if not all can be kept: by rank, then those
/// with the most room around them on their front (its ends before all), then by position. Room is
/// measured on the logarithms, because costs differ by factors.
[[nodiscard]] std::vector<std::size_t> by_promise(std::span<const Cost> costs);

/// At most `most` positions of `front`, which is ordered by completion: both ends, and between them
/// those that leave the least gap.
[[nodiscard]] std::vector<std::size_t> spread_out(std::span<const Cost> costs,
                                                  std::vector<std::size_t> front, std::size_t most);

}  // namespace stormproof::tune
