// If differences are symmetric about 0, each rank counts or not with probability 1/2, so the
// distribution of the rank sum is that of the sums of subsets of 1 … n. The interval goes from the
// k-th least to the k-th greatest of the N = n(n + 1)/2 pair means, with the greatest k for which
// 2·P(sum < k) ≤ 5 %; it misses the centre with that probability.
#include "checker/experiments/tune/shift.hpp"

#include <algorithm>
#include <cmath>

namespace stormproof::tune {

namespace {

constexpr double most_missed = 0.05;
/// Up to here the distribution is counted out; beyond, the normal one differs by less than 0.1 %.
constexpr std::size_t most_counted = 120;

struct Rank {
  std::size_t k = 1;  ///< from 1
  double confidence = 0;
};

Rank counted_rank(std::size_t n) {
  const std::size_t pairs = n * (n + 1) / 2;
  std::vector<double> probability(pairs + 1, 0);
  probability[0] = 1;
  for (std::size_t rank = 1; rank <= n; ++rank) {
    for (std::size_t sum = pairs + 1; sum-- > 0;) {
      const double without = probability[sum];
      const double with = sum >= rank ? probability[sum - rank] : 0;
      probability[sum] = (without + with) / 2;
    }
  }
  double missed = 2 * probability[0];
  Rank rank{1, 1 - missed};
  for (std::size_t k = 2; 2 * k <= pairs; ++k) {
    missed += 2 * probability[k - 1];
    if (missed > most_missed) break;
    rank = {k, 1 - missed};
  }
  return rank;
}

Rank normal_rank(std::size_t n) {
  const double count = static_cast<double>(n);
  const double mean = count * (count + 1) / 4;
  const double deviation = std::sqrt(count * (count + 1) * (2 * count + 1) / 24);
  constexpr double quantile = 1.959964;  // of 97.5 %
  return {static_cast<std::size_t>(std::floor(mean - quantile * deviation)), 1 - most_missed};
}

double middle(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

}  // namespace

Shift shift_of(std::vector<double> differences) {
  const std::size_t n = differences.size();
  std::vector<double> means;
  means.reserve(n * (n + 1) / 2);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a; b < n; ++b) means.push_back((differences[a] + differences[b]) / 2);
  }
  std::ranges::sort(means);
  Shift shift;
  shift.estimate = middle(means);
  const Rank rank = n <= most_counted ? counted_rank(n) : normal_rank(n);
  shift.low = means[rank.k - 1];
  shift.high = means[means.size() - rank.k];
  shift.confidence = n == 1 ? 0 : rank.confidence;
  return shift;
}

}  // namespace stormproof::tune
