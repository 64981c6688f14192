// Means, ratios, spreads and the loopback normalisation.
#include "checker/experiments/reproduce/measures.hpp"

#include <algorithm>
#include <cmath>

#include "checker/experiments/statistics/quantiles.hpp"
#include "model/reference.hpp"

namespace stormproof::reproduce {

namespace {

using model::HeartbeatPolicy;

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// (largest − least) / largest of the values of the three orders.
template <class Value>
std::optional<double> spread(const Results& results, std::size_t variant, const Configuration& one,
                             Value value) {
  double least = 0;
  double most = 0;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const Outcome* outcome =
        results.find({variant, Network::wireless, HeartbeatPolicy::periodic, orders[k], one});
    const std::optional<double> found = outcome ? value(*outcome) : std::nullopt;
    if (!found) return std::nullopt;
    least = k == 0 ? *found : std::min(least, *found);
    most = k == 0 ? *found : std::max(most, *found);
  }
  return most == 0 ? 0 : (most - least) / most;
}

}  // namespace

Quartiles quartiles(std::vector<double> values) {
  std::ranges::sort(values);
  using statistics::quantile_of_sorted;
  return {quantile_of_sorted(values, 0.25), quantile_of_sorted(values, 0.5),
          quantile_of_sorted(values, 0.75)};
}

double LoopbackNormalisation::sedp(double messages) const { return messages * all / loopback; }

double LoopbackNormalisation::spdp(double messages) const {
  return messages * (all * all) / (loopback * loopback);
}

LoopbackNormalisation loopback_normalisation(std::uint32_t hosts, std::uint32_t participants) {
  return {static_cast<double>(hosts) * participants,
          static_cast<double>(hosts - 1) * participants + 1};
}

template <class Value>
std::optional<std::vector<double>> Measures::everywhere(Value value) const {
  std::vector<double> values;
  for (const Configuration& one : results_.plan.configurations) {
    const std::optional<double> found = value(one);
    if (!found) return std::nullopt;
    values.push_back(*found);
  }
  if (values.empty()) return std::nullopt;
  return values;
}

template <class Value>
std::optional<double> Measures::mean_over_endpoints(std::size_t variant, HeartbeatPolicy policy,
                                                    std::uint32_t participants, Value value) const {
  double sum = 0;
  std::size_t count = 0;
  for (const Configuration& one : results_.plan.configurations) {
    if (one.participants_per_host != participants) continue;
    const Outcome* outcome = results_.find({variant, Network::wireless, policy, orders[0], one});
    const std::optional<double> found = outcome ? value(*outcome) : std::nullopt;
    if (!found) return std::nullopt;
    sum += *found;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::optional<double> Measures::mean_completion_s(std::size_t variant, HeartbeatPolicy policy,
                                                  std::uint32_t participants) const {
  return mean_over_endpoints(variant, policy, participants,
                             [](const Outcome& outcome) { return outcome.completion_s(); });
}

std::optional<double> Measures::mean_messages(std::size_t variant, HeartbeatPolicy policy,
                                              std::uint32_t participants) const {
  return mean_over_endpoints(variant, policy, participants,
                             [](const Outcome& outcome) { return outcome.messages(Class::total); });
}

std::optional<double> Measures::wireless_to_wired(std::size_t variant,
                                                  const Configuration& one) const {
  const Outcome* wireless = results_.find(variant, Network::wireless, one);
  const Outcome* wired = results_.find(variant, Network::wired, one);
  if (wireless == nullptr || wired == nullptr) return std::nullopt;
  const std::optional<double> above = wireless->messages(Class::total);
  const std::optional<double> below = wired->messages(Class::total);
  if (!above || !below || *below == 0) return std::nullopt;
  return *above / *below;
}

std::optional<double> Measures::largest_wireless_to_wired(std::size_t variant) const {
  const auto all =
      everywhere([&](const Configuration& one) { return wireless_to_wired(variant, one); });
  if (!all) return std::nullopt;
  return largest(*all);
}

double Measures::open_loop_s(std::size_t variant, const Configuration& one) const {
  const model::Scenario scenario = results_.plan.scenario(
      {variant, Network::wireless, HeartbeatPolicy::periodic, orders[0], one}, 0);
  // The plan's wireless network is a shared channel, which always has an airtime.
  const auto airtime = model::open_loop_airtime(scenario);
  return airtime ? static_cast<double>(airtime->count()) * 1e-9 : 0;
}

std::optional<Quartiles> Measures::open_loop_fraction(std::size_t variant) const {
  std::vector<double> fractions;
  for (const Configuration& one : results_.plan.configurations) {
    if (!results_.plan.high_load(one)) continue;
    const Outcome* outcome = results_.find(variant, Network::wireless, one);
    const std::optional<double> closed = outcome ? outcome->completion_s() : std::nullopt;
    if (!closed) return std::nullopt;
    fractions.push_back(open_loop_s(variant, one) / *closed);
  }
  if (fractions.empty()) return std::nullopt;
  return quartiles(std::move(fractions));
}

std::optional<double> Measures::completion_spread(std::size_t variant,
                                                  const Configuration& one) const {
  return spread(results_, variant, one,
                [](const Outcome& outcome) { return outcome.completion_s(); });
}

std::optional<double> Measures::message_spread(std::size_t variant, Class what,
                                               const Configuration& one) const {
  return spread(results_, variant, one,
                [what](const Outcome& outcome) { return outcome.messages(what); });
}

std::optional<Quartiles> Measures::completion_spreads(std::size_t variant) const {
  const auto all =
      everywhere([&](const Configuration& one) { return completion_spread(variant, one); });
  if (!all) return std::nullopt;
  return quartiles(*all);
}

std::optional<double> Measures::largest_completion_spread(std::size_t variant) const {
  const auto all =
      everywhere([&](const Configuration& one) { return completion_spread(variant, one); });
  if (!all) return std::nullopt;
  return largest(*all);
}

std::optional<double> Measures::largest_message_spread(std::size_t variant, Class what) const {
  const auto all =
      everywhere([&](const Configuration& one) { return message_spread(variant, what, one); });
  if (!all) return std::nullopt;
  return largest(*all);
}

std::optional<double> Measures::loopback_messages(std::size_t variant, Class what,
                                                  const Configuration& one) const {
  const Outcome* loopback = results_.find(variant, Network::loopback, one);
  const auto spdp = loopback ? loopback->messages(Class::spdp) : std::nullopt;
  if (!spdp) return std::nullopt;
  const LoopbackNormalisation normalise =
      loopback_normalisation(results_.plan.hosts, one.participants_per_host);
  switch (what) {
    case Class::spdp:
    case Class::spdp_multicast:
    case Class::spdp_unicast:
      return normalise.spdp(*loopback->messages(what));
    case Class::total:
      return normalise.spdp(*spdp) + normalise.sedp(*loopback->messages(Class::total) - *spdp);
    default:
      return normalise.sedp(*loopback->messages(what));
  }
}

double Measures::reference_messages(std::size_t variant, Class what,
                                    const Configuration& one) const {
  const model::Scenario scenario = results_.plan.scenario(
      {variant, Network::wireless, HeartbeatPolicy::periodic, orders[0], one}, 0);
  return static_cast<double>(count_of(model::failure_free_reference(scenario), what));
}

std::optional<double> Measures::loopback_error(std::size_t variant, Class what) const {
  double sum = 0;
  const auto all = everywhere([&](const Configuration& one) -> std::optional<double> {
    const std::optional<double> loopback = loopback_messages(variant, what, one);
    const double reference = reference_messages(variant, what, one);
    if (!loopback || reference == 0) return std::nullopt;
    return std::abs(*loopback - reference) / reference;
  });
  if (!all) return std::nullopt;
  for (const double value : *all) sum += value;
  return sum / static_cast<double>(all->size());
}

std::optional<double> Measures::loopback_configurations_with_repair(std::size_t variant) const {
  const auto all = everywhere([&](const Configuration& one) -> std::optional<double> {
    const Outcome* loopback = results_.find(variant, Network::loopback, one);
    if (loopback == nullptr) return std::nullopt;
    return std::any_of(loopback->runs.begin(), loopback->runs.end(),
                       [](const Run& run) { return run.counts.repair_data > 0; })
               ? 1
               : 0;
  });
  if (!all) return std::nullopt;
  return static_cast<double>(std::count(all->begin(), all->end(), 1.0));
}

}  // namespace stormproof::reproduce
