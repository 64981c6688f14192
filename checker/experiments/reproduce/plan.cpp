// The rows of the evaluation and the scenario of each.
#include "checker/experiments/reproduce/plan.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "model/config/scenario_file.hpp"

namespace stormproof::reproduce {

namespace {

using model::HeartbeatPolicy;
using model::Nanoseconds;
using model::ServiceOrder;
using model::config::InputError;
using model::config::Result;

struct VariantSource {
  const char* id;
  const char* title;
  const char* profile;
  std::string_view wireless;
  bool staggered;
};

// Fast DDS creates its endpoints over time, so its outcome is a distribution over start times. The
// paper states that all processes start at one instant and does not print when their endpoints
// existed; so Fast DDS is run both ways: everything at time 0, the assumption of the paper's
// model, and with start times drawn from ranges. Last, on the channel that Linux and 802.11 make:
// fragments are handed over at once, and a sender whose buffer is full waits.
constexpr std::string_view papers_channel = "wifi-80211n-paper";
constexpr std::array<VariantSource, 5> sources{
    {{"paper", "paper's model, simultaneous start", "paper", papers_channel, false},
     {"fastdds-2.6.11-relations", "paper's model with relation rules of Fast DDS, simultaneous",
      "fastdds-2.6.11-relations", papers_channel, false},
     {"fastdds-2.6.11", "Fast DDS 2.6.11, simultaneous start", "fastdds-2.6.11", papers_channel,
      false},
     {"fastdds-2.6.11-staggered", "Fast DDS 2.6.11, drawn start times", "fastdds-2.6.11",
      papers_channel, true},
     {"fastdds-2.6.11-true-channel", "Fast DDS 2.6.11 over hosts that wait, drawn start times",
      "fastdds-2.6.11", "wifi-80211n", true}}};

/// Start times in the ranges that were fitted to live runs of Fast DDS on another machine, as in
/// specs/scenarios/live-5x20.yaml: `processes` a host, `endpoints` each, user and default ones.
model::Schedule live_schedule(std::int64_t processes, std::int64_t endpoints) {
  constexpr std::int64_t microsecond = 1'000;
  const std::int64_t created = processes * endpoints;
  const std::int64_t low = -700 + 2'900 * processes + 200 * created;
  const std::int64_t high = -27'000 + 15'400 * processes + 455 * created;
  model::Schedule schedule;
  schedule.start_min = Nanoseconds{3'000 * microsecond};
  schedule.start_max = Nanoseconds{12'000 * processes * microsecond};
  schedule.endpoints_done_min = Nanoseconds{low * microsecond};
  schedule.endpoints_done_max = Nanoseconds{std::max(low, high) * microsecond};
  return schedule;
}

void add_cases(Plan& plan, std::size_t variant) {
  // Large configurations first: they take longest, and none should be left for the end.
  const auto add = [&](Network network, HeartbeatPolicy policy, ServiceOrder order) {
    for (auto one = plan.configurations.rbegin(); one != plan.configurations.rend(); ++one) {
      plan.cases.push_back({variant, network, policy, order, *one});
    }
  };
  add(Network::wireless, HeartbeatPolicy::periodic, orders[0]);
  add(Network::wireless, HeartbeatPolicy::adaptive, orders[0]);
  add(Network::wired, HeartbeatPolicy::periodic, orders[0]);
  add(Network::loopback, HeartbeatPolicy::periodic, orders[0]);
  // Between drawn runs the draws differ far more than the orders do.
  if (plan.variants[variant].staggered) return;
  add(Network::wireless, HeartbeatPolicy::periodic, orders[1]);
  add(Network::wireless, HeartbeatPolicy::periodic, orders[2]);
}

std::uint32_t whole(double value) { return static_cast<std::uint32_t>(value); }

}  // namespace

const char* name_of(Network network) {
  switch (network) {
    case Network::wireless:
      return "wireless";
    case Network::wired:
      return "wired";
    case Network::loopback:
      return "loopback";
  }
  std::abort();
}

std::vector<std::string> variant_ids() {
  std::vector<std::string> ids;
  for (const VariantSource& source : sources) ids.emplace_back(source.id);
  return ids;
}

std::uint32_t Plan::loopback_participants(const Configuration& one) const {
  return (hosts - 1) * one.participants_per_host + 1;
}

model::Scenario Plan::scenario(const Case& one, std::uint64_t k) const {
  const Variant& variant = variants[one.variant];
  const Configuration& size = one.configuration;
  model::Scenario scenario;
  scenario.dds = variant.dds;
  scenario.dds.sedp.heartbeat_policy = one.policy;
  scenario.wireless = one.network == Network::wireless ? variant.wireless : wired;
  if (one.network == Network::wireless && !variant.staggered) scenario.wireless.order = one.order;
  // A loopback run discovers among participants of one host. Here each has a host of its own, so
  // that all pairs count, without any contention.
  const bool loopback = one.network == Network::loopback;
  scenario.deployment = model::Deployment::homogeneous(
      loopback ? loopback_participants(size) : hosts, loopback ? 1 : size.participants_per_host,
      size.endpoints_per_participant);
  if (variant.staggered) {
    const auto& descriptors = scenario.dds.descriptors;
    scenario.deployment.schedule =
        live_schedule(size.participants_per_host, std::int64_t{descriptors.default_publications} +
                                                      descriptors.default_subscriptions +
                                                      size.endpoints_per_participant);
    scenario.deployment.schedule->seed = k;
    scenario.deployment.draw_schedule(k);
  }
  return scenario;
}

Result<Plan> make_plan(const Published& published, const PlanOptions& options,
                       const model::config::SpecPath& specs) {
  Plan plan;
  plan.hosts = whole(published.values("grid.hosts").front());
  for (const double np : published.values("grid.participants_per_host")) {
    for (const double ne : published.values("grid.endpoints_per_participant")) {
      plan.configurations.push_back({whole(np), whole(ne)});
    }
  }
  plan.high_load_from = {
      whole(published.values("high_load.participants_per_host_min").front()),
      whole(published.values("high_load.endpoints_per_participant_min").front())};
  auto wired = model::config::read_wireless_profile("wired", {}, specs);
  if (!wired) return wired.error();
  plan.wired = *wired;
  const auto wanted = [&](const std::string& id) {
    return options.variants.empty() || std::find(options.variants.begin(), options.variants.end(),
                                                 id) != options.variants.end();
  };
  for (const VariantSource& source : sources) {
    if (!wanted(source.id)) continue;
    auto dds = model::config::read_dds_profile(source.profile, {}, specs);
    if (!dds) return dds.error();
    auto wireless = model::config::read_wireless_profile(std::string{source.wireless}, {}, specs);
    if (!wireless) return wireless.error();
    plan.variants.push_back({source.id, source.title, *dds, *wireless, source.staggered,
                             source.staggered ? options.samples : 1});
    add_cases(plan, plan.variants.size() - 1);
  }
  return plan;
}

}  // namespace stormproof::reproduce
