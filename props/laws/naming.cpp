// Laws of naming. Numbers of hosts and names of stages and channels mean nothing. The numbers of
// participants do: loops over participants are ascending, and announcements of one instant go in
// their order. So two participants may change places exactly if no rule ever looks at both:
//   * nothing of them is scheduled for the same instant before the run (starts; with Fast DDS the
//     creations of endpoints, too), and
//   * no participant loops over both. In the paper's model a participant loops over those of other
//     hosts, so the two have to be on different hosts, and the deployment may have no third host.
//     With Fast DDS every participant loops over all others, so the deployment may have no other.
// A participant of the paper's model that does not start within the time limit takes part in
// nothing and may have any number. specs/findings/participant-order.md shows what happens when
// other participants change places.
#include <algorithm>
#include <numeric>
#include <set>

#include <fmt/core.h>

#include "model/engine/topology.hpp"
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"

namespace stormproof::props {

namespace {

using model::Participant;
using model::Scenario;
using Broken = std::optional<std::string>;

Broken host_names(const Scenario& scenario, const Simulate& simulate) {
  Scenario other = scenario;
  std::uint32_t highest = 0;
  for (const Participant& p : scenario.deployment.participants) {
    highest = std::max(highest, p.host.value);
  }
  for (Participant& p : other.deployment.participants) p.host.value = highest - p.host.value;
  return run_difference(scenario, other, simulate);
}

Broken route_names(const Scenario& scenario, const Simulate& simulate) {
  Scenario other = scenario;
  for (model::Stage& stage : other.wireless.stages) {
    stage.channel = "ether " + stage.channel;
    stage.name = "one";
  }
  return run_difference(scenario, other, simulate);
}

/// When something of the participant is scheduled before the run.
std::set<std::int64_t> initial_times(const Scenario& scenario, const Participant& p) {
  std::set<std::int64_t> times{p.start.count()};
  if (!traits_of(scenario).creates_endpoints_over_time) return times;
  const model::DescriptorProfile& defaults = scenario.dds.descriptors;
  const std::int64_t count = std::int64_t{defaults.default_publications} +
                             defaults.default_subscriptions + p.publications + p.subscriptions;
  const std::int64_t span = (p.endpoints_done - p.start).count();
  for (std::int64_t k = 0; k < count; ++k) times.insert(p.start.count() + span * (k + 1) / count);
  return times;
}

bool may_change_places(const Scenario& scenario, const Participant& a, const Participant& b) {
  const bool same_host = traits_of(scenario).discovers_same_host;
  if (!same_host && std::max(a.start, b.start) > scenario.time_limit) return true;
  const bool seen_together = same_host ? scenario.deployment.size() > 2
                                       : a.host == b.host || scenario.deployment.host_count() > 2;
  if (seen_together) return false;
  const std::set<std::int64_t> times = initial_times(scenario, a);
  return std::ranges::none_of(initial_times(scenario, b),
                              [&](std::int64_t time) { return times.contains(time); });
}

/// The participants in an order that is as far from theirs as allowed.
std::vector<std::uint32_t> reordered(const Scenario& scenario) {
  const std::vector<Participant>& list = scenario.deployment.participants;
  std::vector<std::uint32_t> order(list.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t round = 0; round < order.size(); ++round) {
    for (std::size_t k = 1; k < order.size(); ++k) {
      if (order[k - 1] > order[k]) continue;  // they have changed places already
      if (may_change_places(scenario, list[order[k - 1]], list[order[k]])) {
        std::swap(order[k - 1], order[k]);
      }
    }
  }
  return order;
}

bool can_reorder(const Scenario& scenario) { return !std::ranges::is_sorted(reordered(scenario)); }

Broken participant_order(const Scenario& scenario, const Simulate& simulate) {
  const std::vector<std::uint32_t> order = reordered(scenario);
  Scenario other = scenario;
  Reading reading;
  reading.insertions = false;
  reading.number.resize(order.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    other.deployment.participants[k] = scenario.deployment.participants[order[k]];
    reading.number[order[k]] = k;
  }
  return run_difference(scenario, other, simulate, reading);
}

constexpr Law naming_list[] = {
    {"law.host-names", "Hosts may be renumbered.", always, host_names},
    {"law.route-names", "Stages and channels may be renamed.", always, route_names},
    {"law.participant-order",
     "Participants that no rule looks at together may change places: nothing of them is scheduled "
     "for one instant before the run, and nobody sees both.",
     can_reorder, participant_order},
};

}  // namespace

std::span<const Law> naming_laws() { return naming_list; }

}  // namespace stormproof::props
