// Intervals of the means and of their quotient, draw by draw: both policies meet the same draws.
#include "checker/experiments/reproduce/decided.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "checker/experiments/reproduce/figures.hpp"
#include "checker/experiments/statistics/completion.hpp"
#include "checker/experiments/statistics/confidence.hpp"
#include "checker/experiments/statistics/stratified.hpp"

namespace stormproof::reproduce {

namespace {

using model::HeartbeatPolicy;
using statistics::MeanInterval;
using Strata = std::vector<std::vector<double>>;

constexpr std::size_t first_look = 2;
constexpr std::size_t second_look = 3;

double seconds_of(const Run& run) {
  return run.completion ? static_cast<double>(run.completion->count()) * 1e-9
                        : statistics::unreached;
}
double messages_of(const Run& run) {
  return run.completion ? static_cast<double>(run.counts.total()) : statistics::unreached;
}

/// A stratum for each configuration of this N_P.
template <class Value>
Strata strata_of(const Results& results, std::size_t variant, HeartbeatPolicy policy,
                 std::uint32_t participants, Value value) {
  Strata strata;
  for (const Configuration& one : results.plan.configurations) {
    if (one.participants_per_host != participants) continue;
    std::vector<double>& stratum = strata.emplace_back();
    const Outcome* outcome = results.find({variant, Network::wireless, policy, orders[0], one});
    if (outcome == nullptr) continue;
    for (const Run& run : outcome->runs) stratum.push_back(value(run));
  }
  return strata;
}

/// The published value with what counts as close, if there is such a figure.
bool is_decided(const Published& published, const std::string& id,
                const std::optional<MeanInterval>& interval, double factor, double offset = 0) {
  const PublishedFigure* figure = published.find(id);
  if (figure == nullptr || !interval) return true;
  const double value = figure->values.front();
  const double share = close_share * std::abs(value);
  const double low = factor * (interval->low + offset);
  const double high = factor * (interval->high + offset);
  const bool within = low >= value - share && high <= value + share;
  return within || high < value - share || low > value + share;
}

}  // namespace

std::vector<std::size_t> looks(std::size_t most) {
  std::vector<std::size_t> list;
  for (const std::size_t draws : {first_look, second_look}) {
    if (draws < most) list.push_back(draws);
  }
  list.push_back(most);
  return list;
}

double confidence_of_look(std::size_t most) {
  return 1 - (1 - statistics::confidence_level) / static_cast<double>(looks(most).size());
}

bool means_are_decided(const Published& published, const Results& results, std::size_t variant,
                       std::uint32_t participants, double confidence) {
  constexpr double percent = 100;
  const auto all_of_quantity = [&](const char* quantity, const char* name, auto value) {
    const Strata baseline =
        strata_of(results, variant, HeartbeatPolicy::periodic, participants, value);
    const Strata adaptive =
        strata_of(results, variant, HeartbeatPolicy::adaptive, participants, value);
    const auto mean = statistics::stratified_mean(baseline, confidence);
    const std::string means = fmt::format("observed_means.np{}.", participants);
    const std::string observed = means + quantity + ".baseline";
    const double ratio =
        published.find(observed) == nullptr ? 1 : 1 / published.values(observed).front();
    return is_decided(published, observed, mean, 1) &&
           is_decided(published, means + quantity + ".adaptive",
                      statistics::stratified_mean(adaptive, confidence), 1) &&
           is_decided(published, means + name + "_change_pct",
                      statistics::stratified_ratio(adaptive, baseline, confidence), percent, -1) &&
           is_decided(published, fmt::format("upper_range.np{}.{}.median", participants, name),
                      mean, ratio);
  };
  return all_of_quantity("completion_s", "completion", seconds_of) &&
         all_of_quantity("messages", "messages", messages_of);
}

}  // namespace stormproof::reproduce
