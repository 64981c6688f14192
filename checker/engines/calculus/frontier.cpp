// Variants of the deployment, and the search.
#include "checker/engines/calculus/frontier.hpp"

#include <algorithm>
#include <map>

#include "checker/engines/calculus/cannot_start.hpp"
#include "props/applicability.hpp"

namespace stormproof::calculus {

namespace {

using model::Participant;
using model::Scenario;
using Participants = std::vector<Participant>;

constexpr std::uint32_t most_endpoints = 10'000;
/// Beyond it the pairs of one deployment take long to count.
constexpr std::uint32_t most_participants = 400;

/// Participants by host.
std::vector<Participants> hosts_of(const Scenario& scenario) {
  std::map<std::uint32_t, Participants> hosts;
  for (const Participant& participant : scenario.deployment.participants) {
    hosts[participant.host.value].push_back(participant);
  }
  std::vector<Participants> list;
  for (auto& [host, participants] : hosts) list.push_back(std::move(participants));
  return list;
}

/// Every participant with so many user endpoints, publications first as in the short form.
Scenario with_endpoints(Scenario scenario, std::uint32_t endpoints) {
  for (Participant& participant : scenario.deployment.participants) {
    participant.publications = endpoints - endpoints / 2;
    participant.subscriptions = endpoints / 2;
  }
  return scenario;
}

/// `hosts` hosts with `each` participants, like those that there are, in turn.
Scenario with_participants(Scenario scenario, std::uint32_t hosts,
                           const std::optional<std::uint32_t>& each) {
  const std::vector<Participants> templates = hosts_of(scenario);
  Participants all;
  for (std::uint32_t host = 0; host < hosts; ++host) {
    const Participants& like = templates[host % templates.size()];
    const auto count = each.value_or(static_cast<std::uint32_t>(like.size()));
    for (std::uint32_t k = 0; k < count; ++k) {
      all.push_back(like[k % like.size()]);
      all.back().host.value = host;
    }
  }
  scenario.deployment.participants = std::move(all);
  return scenario;
}

/// Doubles from the least on, then halves the rest.
template <class Variant>
void search(Frontier& frontier, const Variant& variant) {
  const auto holds = [&](std::uint32_t load) {
    const Scenario loaded = variant(load);
    if (!props::applicability_of(cannot_start, loaded).is_decided_by(props::Engine::calculus))
      return false;
    const Judged judged = judge(loaded);
    if (!judged.is_proved()) return false;
    frontier.most = load;
    frontier.delay = judged.threshold.unlimited ? std::nullopt : judged.delay;
    return true;
  };
  if (!holds(frontier.least)) return;
  std::uint32_t beyond = frontier.limit + 1;
  for (std::uint32_t next = frontier.least; *frontier.most < frontier.limit;) {
    next = std::min(frontier.limit, std::max(1U, 2 * next));
    if (holds(next)) continue;
    beyond = next;
    break;
  }
  std::uint32_t proved = *frontier.most;
  while (beyond - proved > 1) {
    const std::uint32_t middle = proved + (beyond - proved) / 2;
    (holds(middle) ? proved : beyond) = middle;
    if (beyond > frontier.limit) break;
  }
}

template <class Get>
std::optional<std::uint32_t> common(const auto& all, const Get& get) {
  const auto first = get(all.front());
  const bool alike = std::ranges::all_of(all, [&](const auto& one) { return get(one) == first; });
  return alike ? std::optional{static_cast<std::uint32_t>(first)} : std::nullopt;
}

}  // namespace

Frontiers frontier_of(const Scenario& scenario) {
  const props::Applicability answer = props::applicability_of(cannot_start, scenario);
  if (!answer.applies()) return {answer.why_not, {}, {}};
  const auto hosts = hosts_of(scenario);
  const auto host_count = static_cast<std::uint32_t>(hosts.size());
  const auto largest_host = static_cast<std::uint32_t>(
      std::ranges::max(hosts, {}, [](const Participants& p) { return p.size(); }).size());
  Frontier endpoints{
      .load = "user endpoints of each participant",
      .now = common(scenario.deployment.participants,
                    [](const Participant& p) { return p.publications + p.subscriptions; }),
      .limit = most_endpoints};
  search(endpoints, [&](std::uint32_t load) { return with_endpoints(scenario, load); });
  Frontier participants{.load = "participants of each host",
                        .now = common(hosts, [](const Participants& p) { return p.size(); }),
                        .least = 1,
                        .limit = std::max(1U, most_participants / host_count)};
  search(participants,
         [&](std::uint32_t load) { return with_participants(scenario, host_count, load); });
  Frontier machines{.load = "hosts",
                    .now = host_count,
                    .least = 2,
                    .limit = std::max(2U, most_participants / largest_host)};
  search(machines, [&](std::uint32_t load) { return with_participants(scenario, load, {}); });
  return {{}, answer.why_not_provable, {endpoints, participants, machines}};
}

}  // namespace stormproof::calculus
