// The number of differences below the true median is binomial with probability 1/2. So the interval
// from the k-th least to the k-th greatest of n differences misses it with probability
// 2·P(Bin(n, 1/2) < k).
#include "checker/experiments/sensitivity/effect.hpp"

#include <algorithm>
#include <cmath>

namespace stormproof::sensitivity {

namespace {

struct Rank {
  std::size_t k = 1;  ///< from 1
  double confidence = 0;
};

/// The narrowest interval with 95 %; the widest one if there is none.
Rank rank_for(std::size_t n) {
  const double count = static_cast<double>(n);
  const auto probability = [count](double hits) {
    return std::exp(std::lgamma(count + 1) - std::lgamma(hits + 1) - std::lgamma(count - hits + 1) -
                    count * std::log(2.0));
  };
  double missed = 2 * probability(0);
  Rank rank{1, 1 - missed};
  for (std::size_t k = 2; 2 * k <= n; ++k) {
    missed += 2 * probability(static_cast<double>(k - 1));
    if (missed > 0.05) break;
    rank = {k, 1 - missed};
  }
  return rank;
}

double middle(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

}  // namespace

Effect effect_of(std::vector<double> differences) {
  std::ranges::sort(differences);
  Effect effect;
  effect.median = middle(differences);
  effect.low = effect.high = effect.median;
  effect.exactly_zero = differences.front() == 0 && differences.back() == 0;
  if (differences.size() == 1) return effect;
  const Rank rank = rank_for(differences.size());
  effect.low = differences[rank.k - 1];
  effect.high = differences[differences.size() - rank.k];
  effect.confidence = rank.confidence;
  return effect;
}

}  // namespace stormproof::sensitivity
