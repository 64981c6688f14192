// One pass over the costs in the order of completion gives a front; taking fronts away one after
// the other gives the ranks.
#include "checker/experiments/tune/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace stormproof::tune {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// By how much two logarithms differ.
double factor(double a, double b) { return a == b ? 0 : std::abs(std::log1p(a) - std::log1p(b)); }

double distance(const Cost& a, const Cost& b) {
  return factor(a.completion, b.completion) + factor(a.messages, b.messages) +
         std::abs(a.missing - b.missing);
}

/// The front of the positions in `among`.
std::vector<std::size_t> front_of(std::span<const Cost> costs, std::vector<std::size_t> among) {
  std::ranges::sort(among, [&](std::size_t a, std::size_t b) {
    if (is_sooner(costs[a], costs[b])) return true;
    if (is_sooner(costs[b], costs[a])) return false;
    if (costs[a].messages != costs[b].messages) return costs[a].messages < costs[b].messages;
    return a < b;
  });
  std::vector<std::size_t> front;
  for (const std::size_t k : among) {
    if (front.empty() || costs[k].messages < costs[front.back()].messages) front.push_back(k);
  }
  return front;
}

std::vector<std::size_t> all_positions(std::size_t count) {
  std::vector<std::size_t> positions(count);
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  return positions;
}

}  // namespace

bool is_sooner(const Cost& a, const Cost& b) {
  return a.completion != b.completion ? a.completion < b.completion : a.missing < b.missing;
}

bool dominates(const Cost& a, const Cost& b) {
  return !is_sooner(b, a) && a.messages <= b.messages &&
         (is_sooner(a, b) || a.messages < b.messages);
}

std::vector<std::size_t> pareto_front(std::span<const Cost> costs) {
  return front_of(costs, all_positions(costs.size()));
}

std::vector<std::size_t> pareto_ranks(std::span<const Cost> costs) {
  std::vector<std::size_t> ranks(costs.size());
  std::vector<std::size_t> rest = all_positions(costs.size());
  for (std::size_t rank = 0; !rest.empty(); ++rank) {
    std::vector<Cost> on_front;
    for (const std::size_t k : front_of(costs, rest)) on_front.push_back(costs[k]);
    std::erase_if(rest, [&](std::size_t k) {
      // Equal costs share their rank, though a front lists them once.
      if (std::ranges::find(on_front, costs[k]) == on_front.end()) return false;
      ranks[k] = rank;
      return true;
    });
  }
  return ranks;
}

std::vector<std::size_t> by_promise(std::span<const Cost> costs) {
  const std::vector<std::size_t> ranks = pareto_ranks(costs);
  const std::size_t worst = ranks.empty() ? 0 : *std::ranges::max_element(ranks);
  std::vector<double> room(costs.size(), 0);
  for (std::size_t rank = 0; rank <= worst && !ranks.empty(); ++rank) {
    std::vector<std::size_t> members;
    for (std::size_t k = 0; k < costs.size(); ++k) {
      if (ranks[k] == rank) members.push_back(k);
    }
    const std::vector<std::size_t> line = front_of(costs, members);
    for (std::size_t n = 0; n < line.size(); ++n) {
      const bool is_end = n == 0 || n + 1 == line.size();
      room[line[n]] = is_end ? infinity : distance(costs[line[n - 1]], costs[line[n + 1]]);
    }
  }
  std::vector<std::size_t> order = all_positions(costs.size());
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : room[a] > room[b];
  });
  return order;
}

std::vector<std::size_t> spread_out(std::span<const Cost> costs, std::vector<std::size_t> front,
                                    std::size_t most) {
  while (front.size() > most && front.size() > 2) {
    std::size_t least = 1;
    double least_gap = infinity;
    for (std::size_t n = 1; n + 1 < front.size(); ++n) {
      const double gap = distance(costs[front[n - 1]], costs[front[n + 1]]);
      if (gap < least_gap) {
        least = n;
        least_gap = gap;
      }
    }
    front.erase(front.begin() + static_cast<std::ptrdiff_t>(least));
  }
  if (front.size() > most) front.resize(most);
  return front;
}

}  // namespace stormproof::tune
