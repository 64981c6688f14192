// Shrinking for users: a changed scenario goes back towards the given one, and only what matters
// stays different. And what RapidCheck itself makes of the generators: shrunk profiles and
// deployments, and failures printed as files.
#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "props/generators/complexity.hpp"
#include "props/generators/scenarios.hpp"
#include "props/generators/simpler.hpp"

namespace stormproof::props {
namespace towards_base_test {

using model::Nanoseconds;
using model::Scenario;

model::config::SpecPath specs() { return model::config::SpecPath::standard(); }

Scenario of_user(const std::string& name) {
  const auto scenario = model::config::read_scenario(name, {}, specs());
  EXPECT_TRUE(scenario);
  return *scenario;
}

Scenario least(Scenario scenario, const Scenario& base,
               const std::function<bool(const Scenario&)>& fails) {
  while (auto simpler = first_simpler(scenario, base, fails)) scenario = *simpler;
  return scenario;
}

/// The user's scenario, with other starts, sizes, timers, rates and losses.
Scenario perturbed(Scenario scenario) {
  std::int64_t k = 0;
  for (model::Participant& p : scenario.deployment.participants) {
    p.start += Nanoseconds{1'234'567 * ++k};
    p.endpoints_done += Nanoseconds{2'345'678 * k};
  }
  scenario.deployment.schedule.reset();
  scenario.dds.spdp.period += Nanoseconds{123'456'789};
  scenario.dds.sedp.heartbeat_period += Nanoseconds{98'765'432};
  scenario.dds.sedp.nack_response_delay += Nanoseconds{77'777};
  scenario.wireless.overhead_unicast += Nanoseconds{4'321};
  scenario.wireless.rate_multicast += model::BitsPerSecond{123'456};
  scenario.wireless.lost_packets = {3, 77, 78, 500};
  return scenario;
}

TEST(TowardsBase, WhatMattersStays) {
  const Scenario base = of_user("wifi-5x20");
  const auto fails = [&base](const Scenario& s) {
    return s.dds.sedp.heartbeat_period > base.dds.sedp.heartbeat_period &&
           s.wireless.lost_packets.size() == 1;
  };
  Scenario scenario = perturbed(base);
  scenario.wireless.lost_packets = {77};
  Scenario expected = base;
  expected.deployment = model::Deployment::homogeneous(2, 1, 0);
  expected.deployment.loopback_delay = base.deployment.loopback_delay;
  expected.wireless.lost_packets = {0};
  expected.dds.sedp.heartbeat_period = Nanoseconds{10'000'000'000};
  EXPECT_TRUE(least(scenario, base, fails) == expected);
}

TEST(TowardsBase, TheDeploymentStaysIfItMatters) {
  for (const std::string name : {"wifi-5x20", "staggered-joins", "live-5x20"}) {
    const Scenario base = of_user(name);
    const auto fails = [&base](const Scenario& s) {
      return s.deployment.size() == base.deployment.size();
    };
    const Scenario found = least(perturbed(base), base, fails);
    EXPECT_TRUE(found.dds == base.dds && found.wireless == base.wireless) << name;
    for (std::size_t k = 0; k < found.deployment.participants.size(); ++k) {
      const model::Participant& p = found.deployment.participants[k];
      EXPECT_EQ(p.start, base.deployment.participants[k].start) << name;
      EXPECT_EQ(p.endpoints_done, base.deployment.participants[k].endpoints_done) << name;
    }
  }
}

TEST(TowardsBase, TheBaseItselfOnlyGetsSmaller) {
  const Scenario base = of_user("three-hosts");
  for (const Scenario& simpler : simpler_scenarios(base, base)) {
    EXPECT_TRUE(simpler.dds == base.dds && simpler.wireless == base.wireless);
    EXPECT_LT(complexity(simpler, base), complexity(base, base));
  }
  Scenario smallest = base;
  smallest.deployment = model::Deployment::homogeneous(2, 1, 0);
  EXPECT_TRUE(simpler_scenarios(smallest, base).empty());
}

TEST(TowardsBase, LargeDeploymentsTakeCoarseSteps) {
  Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(40, 100, 4);
  const Scenario base = scenario;
  int asked = 0;
  const auto fails = [&asked](const Scenario& s) { return ++asked, s.deployment.size() > 7; };
  EXPECT_EQ(least(scenario, base, fails).deployment.size(), 8U);
  EXPECT_LT(asked, 3'000);
}

/// What is left when RapidCheck has shrunk a value that always fails.
template <class T>
T least_of(const rc::Gen<T>& values, std::uint64_t seed) {
  auto shrinkable = values(rc::Random{seed}, 100);
  while (auto next = shrinkable.shrinks().next()) shrinkable = *next;
  return shrinkable.value();
}

TEST(Parts, ShrinkToTheirDefaults) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    model::DdsProfile dds;
    const model::DdsProfile found = least_of(dds_profiles(), seed);
    dds.implementation = found.implementation;
    EXPECT_TRUE(found == dds);
    EXPECT_TRUE(least_of(wireless_profiles(), seed) == model::WirelessProfile{});
    EXPECT_TRUE(least_of(deployments(), seed) == model::Deployment::homogeneous(2, 1, 0));
  }
}

TEST(Printing, RapidCheckPrintsAFailureAsAFile) {
  const auto property = rc::detail::toProperty([] {
    const Scenario scenario = *scenarios();
    RC_ASSERT(scenario.wireless.lost_packets.size() < 2U);
  });
  int failures = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const auto shrinkable = property(rc::Random{seed}, 100);
    if (shrinkable.value().result.type != rc::detail::CaseResult::Type::Failure) continue;
    ++failures;
    const rc::detail::Example example = shrinkable.value().example();
    ASSERT_EQ(example.size(), 1U);
    const auto read = model::config::parse_scenario(example.front().second, "printed", {}, specs());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_GE(read->wireless.lost_packets.size(), 2U);
  }
  EXPECT_GT(failures, 5);
}

}  // namespace towards_base_test
}  // namespace stormproof::props
