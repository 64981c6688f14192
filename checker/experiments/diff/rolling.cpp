// Enumerates how many hosts of each kind are upgraded, and finds orders on that lattice.
#include "checker/experiments/diff/rolling.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/config/knobs/mixed_profiles.hpp"

namespace stormproof::diff {

namespace {

using model::config::InputError;
using Counts = std::vector<std::uint32_t>;

std::string name_of_host(const model::Deployment& deployment, std::uint32_t host) {
  if (host < deployment.hosts.size()) return deployment.hosts[host].name;
  return fmt::format("host {}", host);
}

/// What a host is to an upgrade; times that a schedule draws are nobody's own.
std::string kind_of(const model::Deployment& deployment, std::uint32_t host) {
  std::string text;
  if (host < deployment.hosts.size()) {
    const model::Host& one = deployment.hosts[host];
    text = fmt::format("{} {} {} {}", static_cast<int>(one.link), one.rate ? one.rate->count() : 0,
                       one.access_point.value_or(""), one.power_save.has_value());
  }
  for (const model::Participant& p : deployment.participants) {
    if (p.host.value != host) continue;
    text += fmt::format("; {} {}", p.publications, p.subscriptions);
    if (deployment.schedule) continue;
    text += fmt::format(" {} {}", p.start.count(), p.endpoints_done.count());
  }
  return text;
}

std::vector<AlikeHosts> kinds_of(const model::Deployment& deployment) {
  std::vector<std::uint32_t> hosts;
  for (const model::Participant& p : deployment.participants) hosts.push_back(p.host.value);
  std::ranges::sort(hosts);
  hosts.erase(std::unique(hosts.begin(), hosts.end()), hosts.end());
  std::map<std::string, std::size_t> known;
  std::vector<AlikeHosts> kinds;
  for (const std::uint32_t host : hosts) {
    const auto [entry, is_new] = known.emplace(kind_of(deployment, host), kinds.size());
    if (is_new) kinds.push_back({{}, name_of_host(deployment, host)});
    kinds[entry->second].hosts.push_back(host);
  }
  return kinds;
}

/// All but that nobody is upgraded, the fewest first.
std::vector<Counts> stages_of(const std::vector<AlikeHosts>& kinds) {
  std::vector<Counts> all{Counts(kinds.size(), 0)};
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const std::size_t before = all.size();
    for (std::uint32_t count = 1; count <= kinds[k].hosts.size(); ++count) {
      for (std::size_t s = 0; s < before; ++s) {
        if (all.size() > most_stages) return all;
        all.push_back(all[s]);
        all.back()[k] = count;
      }
    }
  }
  std::ranges::stable_sort(all, {}, [](const Counts& counts) {
    std::uint32_t sum = 0;
    for (const std::uint32_t count : counts) sum += count;
    return sum;
  });
  all.erase(all.begin());
  return all;
}

/// Which hosts have been upgraded, by name where there are several kinds.
std::string words_of(const std::vector<AlikeHosts>& kinds, const Counts& counts) {
  if (kinds.size() == 1) return fmt::to_string(counts.front());
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (counts[k] == 0) continue;
    parts.push_back(kinds[k].hosts.size() == 1 ? kinds[k].name
                                               : fmt::format("{} of {} like {}", counts[k],
                                                             kinds[k].hosts.size(), kinds[k].name));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// With the candidate on those hosts; on all of them it is the candidate's own scenario.
model::Scenario with_upgraded(const ReviewedPoint& point, const std::vector<AlikeHosts>& kinds,
                              const Counts& counts) {
  std::vector<std::uint32_t> hosts;
  bool all = true;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    hosts.insert(hosts.end(), kinds[k].hosts.begin(), kinds[k].hosts.begin() + counts[k]);
    all = all && counts[k] == kinds[k].hosts.size();
  }
  if (all) return point.candidate;
  model::Scenario mixed = point.base;
  const model::Shared<model::DdsProfile> candidate = point.candidate.dds;
  for (model::Participant& p : mixed.deployment.participants) {
    if (std::ranges::find(hosts, p.host.value) != hosts.end()) p.dds = candidate;
  }
  return mixed;
}

std::optional<InputError> why_not(const ReviewedPoint& point) {
  const std::string expected = model::config::expected_beside(point.base.dds, point.candidate.dds);
  if (!expected.empty()) {
    return InputError{"--rolling",
                      "the two profiles cannot run beside each other; expected " + expected};
  }
  if (!is_mixed(point.base)) return std::nullopt;
  return InputError{
      "--rolling", fmt::format("{}: participants have profiles of their own; expected one profile, "
                               "which the upgrade replaces",
                               point.name)};
}

/// What a fleet costs: never completing is the worst.
struct Cost {
  double completion = 0, messages = 0;
  auto operator<=>(const Cost&) const = default;
};

Cost cost_of(const Configuration& one) {
  const auto median = [&](Measure measure) {
    return one[measure].after.median.value_or(std::numeric_limits<double>::infinity());
  };
  return {median(Measure::completion), median(Measure::messages)};
}

class Orders {
 public:
  Orders(const Stages& stages, const CostComparison& costs) : stages_{stages}, costs_{costs} {
    for (std::size_t s = 0; s < stages.upgraded.size(); ++s) number_of_[stages.upgraded[s]] = s;
  }

  /// Hosts one by one: the last step leads to all of them from whichever fleet before is better, or
  /// worse, and so on back to the first.
  [[nodiscard]] std::vector<RolloutStep> order(bool best) const {
    std::vector<std::pair<Cost, Cost>> worst_on_way(
        stages_.upgraded.size());  // and that of the way
    std::vector<std::size_t> kind_of_step(stages_.upgraded.size());
    for (std::size_t s = 0; s < stages_.upgraded.size(); ++s) {
      const Cost own = cost_of(configuration(s));
      bool is_first = true;
      for (std::size_t k = 0; k < stages_.kinds.size(); ++k) {
        if (stages_.upgraded[s][k] == 0) continue;
        std::pair<Cost, Cost> way{own, own};
        if (const auto before = number_before(s, k)) {
          way = {std::max(own, worst_on_way[*before].first),
                 {own.completion + worst_on_way[*before].second.completion,
                  own.messages + worst_on_way[*before].second.messages}};
        }
        const bool is_wanted = best ? way < worst_on_way[s] : worst_on_way[s] < way;
        if (!is_first && !is_wanted) continue;
        is_first = false;
        worst_on_way[s] = way;
        kind_of_step[s] = k;
      }
    }
    return way_to_all(kind_of_step);
  }

 private:
  [[nodiscard]] const Configuration& configuration(std::size_t stage) const {
    return costs_.configurations[stages_.first_point + stage];
  }
  [[nodiscard]] std::optional<std::size_t> number_before(std::size_t stage,
                                                         std::size_t kind) const {
    Counts before = stages_.upgraded[stage];
    --before[kind];
    const auto found = number_of_.find(before);
    return found == number_of_.end() ? std::nullopt : std::optional{found->second};
  }
  [[nodiscard]] std::vector<RolloutStep> way_to_all(const std::vector<std::size_t>& kinds) const {
    std::vector<RolloutStep> steps;
    std::optional<std::size_t> stage = stages_.upgraded.size() - 1;
    while (stage) {
      const std::size_t k = kinds[*stage];
      const AlikeHosts& kind = stages_.kinds[k];
      const std::uint32_t host = kind.hosts[stages_.upgraded[*stage][k] - 1];
      steps.push_back({host, configuration(*stage).name});
      stage = number_before(*stage, k);
    }
    std::ranges::reverse(steps);
    return steps;
  }

  const Stages& stages_;
  const CostComparison& costs_;
  std::map<Counts, std::size_t> number_of_;
};

}  // namespace

model::config::Result<RollingGrid> rolling_grid(const ReviewedGrid& grid) {
  RollingGrid rolling{{grid.name, {}, grid.samples, grid.first_seed}, {}};
  for (const ReviewedPoint& point : grid.points) {
    if (auto failure = why_not(point)) return *std::move(failure);
    Stages stages{point.name, kinds_of(point.base.deployment), rolling.grid.points.size(), {}};
    stages.upgraded = stages_of(stages.kinds);
    if (rolling.grid.points.size() + stages.upgraded.size() > most_stages) {
      return InputError{"--rolling",
                        fmt::format("more than {} fleets between the two profiles; expected fewer "
                                    "deployments, or hosts that are more alike",
                                    most_stages)};
    }
    const std::uint32_t hosts = point.base.deployment.host_count();
    for (const Counts& counts : stages.upgraded) {
      ReviewedPoint& stage = rolling.grid.points.emplace_back(point);
      const std::string words = words_of(stages.kinds, counts);
      stage.candidate = with_upgraded(point, stages.kinds, counts);
      if (stage.values.empty()) stage.values.emplace_back("fleet", point.name);
      stage.values.emplace_back("upgraded", words);
      stage.name = stages.kinds.size() == 1
                       ? fmt::format("{}, {} of {} hosts upgraded", point.name, words, hosts)
                       : fmt::format("{}, upgraded: {}", point.name, words);
    }
    rolling.stages.push_back(std::move(stages));
  }
  return rolling;
}

std::vector<Rollout> rollouts(const RollingGrid& rolling, const CostComparison& costs) {
  std::vector<Rollout> all;
  if (costs.configurations.size() != rolling.grid.points.size()) return all;
  for (const Stages& stages : rolling.stages) {
    const Orders orders{stages, costs};
    Rollout& one = all.emplace_back();
    one.fleet = stages.fleet;
    one.kinds = stages.kinds.size();
    one.fleets = stages.upgraded.size();
    one.best = orders.order(true);
    one.worst = orders.order(false);
  }
  return all;
}

}  // namespace stormproof::diff
