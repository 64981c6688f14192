// Shrinking: every step is valid and simpler, it comes to an end, and it ends where the generators'
// documentation says: the smallest deployment, the fewest changed knobs, the fewest lost packets,
// round numbers.
#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "props/generators/complexity.hpp"
#include "props/generators/scenarios.hpp"
#include "props/generators/simpler.hpp"

namespace stormproof::props {
namespace shrinking_test {

using model::Nanoseconds;
using model::Scenario;
using Predicate = std::function<bool(const Scenario&)>;

/// What RapidCheck arrives at: always the first shrink that still fails.
Scenario shrunk(rc::Shrinkable<Scenario> shrinkable, const Predicate& fails, int& steps) {
  for (steps = 0;; ++steps) {
    auto simpler = shrinkable.shrinks();
    bool found = false;
    while (auto next = simpler.next()) {
      if (!fails(next->value())) continue;
      shrinkable = *next;
      found = true;
      break;
    }
    if (!found) return shrinkable.value();
  }
}

/// Shrinks random scenarios that fail; `check` looks at what is left.
void for_shrunk(const Predicate& fails, const std::function<void(const Scenario&)>& check) {
  int found = 0;
  for (std::uint64_t seed = 0; found < 10; ++seed) {
    ASSERT_LT(seed, 2'000U);
    const auto shrinkable = scenarios()(rc::Random{seed}, 100);
    if (!fails(shrinkable.value())) continue;
    ++found;
    int steps = 0;
    const Scenario least = shrunk(shrinkable, fails, steps);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(steps) + " steps\n" +
                 model::config::effective_yaml(least));
    check(least);
  }
}

/// Two participants on two hosts that start at once, and nothing else.
model::Deployment smallest() { return model::Deployment::homogeneous(2, 1, 0); }

/// The default scenario with the given one's implementation and time limit.
Scenario plain(const Scenario& scenario) {
  Scenario base;
  base.deployment = smallest();
  base.dds.implementation = scenario.dds.implementation;
  base.time_limit = scenario.time_limit;
  return base;
}

TEST(Shrinking, EndsAtTheSmallestPlainScenario) {
  for_shrunk([](const Scenario&) { return true; },
             [](const Scenario& least) { EXPECT_TRUE(least == plain(least)); });
}

TEST(Shrinking, PlantedFailureWithLossesAndATimer) {
  const auto fails = [](const Scenario& s) {
    return s.wireless.lost_packets.size() > 1 &&
           s.dds.sedp.heartbeat_period < Nanoseconds{1'000'000'000};
  };
  for_shrunk(fails, [](const Scenario& least) {
    Scenario expected = plain(least);
    expected.wireless.lost_packets = {0, 1};
    expected.dds.sedp.heartbeat_period = Nanoseconds{100'000'000};
    EXPECT_TRUE(least == expected);
  });
}

TEST(Shrinking, PlantedFailureInTheDeployment) {
  const auto fails = [](const Scenario& s) {
    std::uint32_t endpoints = 0;
    for (const model::Participant& p : s.deployment.participants) endpoints += p.subscriptions;
    return s.deployment.size() > 2 && endpoints > 4;
  };
  for_shrunk(fails, [](const Scenario& least) {
    EXPECT_EQ(least.deployment.size(), 3U);
    EXPECT_EQ(least.deployment.host_count(), 2U);
    std::uint32_t endpoints = 0;
    for (const model::Participant& p : least.deployment.participants) {
      EXPECT_LE(p.host.value, 1U);
      EXPECT_EQ(p.start, Nanoseconds{0});
      EXPECT_EQ(p.endpoints_done, Nanoseconds{0});
      EXPECT_EQ(p.publications, 0U);
      endpoints += p.subscriptions;
    }
    EXPECT_EQ(endpoints, 5U);
    Scenario rest = least;
    rest.deployment = smallest();
    EXPECT_TRUE(rest == plain(least));
  });
}

TEST(Shrinking, KeepsATie) {
  const auto fails = [](const Scenario& s) {
    const model::SedpProfile& sedp = s.dds.sedp;
    return sedp.nack_response_delay == sedp.heartbeat_period;
  };
  for_shrunk(fails, [](const Scenario& least) {
    Scenario expected = plain(least);
    // One of the two is the default, or both are powers of ten between the defaults.
    const model::SedpProfile& sedp = least.dds.sedp;
    expected.dds.sedp.heartbeat_period = sedp.heartbeat_period;
    expected.dds.sedp.nack_response_delay = sedp.nack_response_delay;
    EXPECT_TRUE(least == expected);
    std::int64_t period = sedp.heartbeat_period.count();
    while (period % 10 == 0) period /= 10;
    EXPECT_EQ(period, 1);
  });
}

TEST(Shrinking, Route) {
  const auto fails = [](const Scenario& s) { return s.wireless.stages.size() > 2; };
  for_shrunk(fails, [](const Scenario& least) {
    ASSERT_EQ(least.wireless.stages.size(), 3U);
    for (const model::Stage& stage : least.wireless.stages) {
      EXPECT_EQ(stage.channel, least.wireless.stages.front().channel);
      EXPECT_EQ(stage.multicast_as, model::MulticastAs::unicast);
      EXPECT_FALSE(stage.overhead_unicast || stage.overhead_multicast || stage.rate_unicast ||
                   stage.rate_multicast);
    }
  });
}

TEST(Shrinking, NumbersGetRound) {
  const auto fails = [](const Scenario& s) {
    return s.dds.spdp.period > Nanoseconds{3'456'789'012};
  };
  for_shrunk(fails, [](const Scenario& least) {
    EXPECT_EQ(least.dds.spdp.period, Nanoseconds{10'000'000'000});
  });
}

TEST(Shrinking, EveryStepIsValidAndSimpler) {
  std::size_t seen = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Scenario scenario = draw_scenario(seed, 100);
    const Scenario base = draw_scenario(seed + 100, 100);
    const Complexity before = complexity(scenario, base);
    std::size_t k = 0;
    for (const Scenario& simpler : simpler_scenarios(scenario, base)) {
      EXPECT_TRUE(model::config::is_valid(simpler)) << "seed " << seed;
      EXPECT_LT(complexity(simpler, base), before) << "seed " << seed;
      EXPECT_TRUE(simpler != scenario) << "seed " << seed;
      if (++k % 10 != 0) continue;
      ++seen;
      const auto read =
          model::config::parse_scenario(model::config::effective_yaml(simpler), "printed", {},
                                        model::config::SpecPath::standard());
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_TRUE(*read == simpler);
    }
  }
  EXPECT_GT(seen, 100U);
}

}  // namespace shrinking_test
}  // namespace stormproof::props
