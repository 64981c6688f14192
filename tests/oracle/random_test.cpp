// Judges the generator of random scenarios: a comparison on scenarios that never finish, never
// repair or all look alike would prove little. The shares are printed, so that a change of the
// generator shows what it did.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::oracle {
namespace random_test {

constexpr std::uint64_t seeds = 400;

struct Share {
  const char* name;
  int (*counts)(const model::Scenario&, const Outcome&);
};

constexpr Share shares[] = {
    {"complete", [](const model::Scenario&, const Outcome& o) { return int{o.completed}; }},
    {"with repairs",
     [](const model::Scenario&, const Outcome& o) { return int{o.repair_data > 0}; }},
    {"with piggyback",
     [](const model::Scenario&, const Outcome& o) { return int{o.piggybacks > 0}; }},
    {"with a lost packet",
     [](const model::Scenario& s, const Outcome& o) {
       const auto& lost = s.wireless.lost_packets;
       return int{!lost.empty() && lost.front() < o.packets};
     }},
    {"adaptive",
     [](const model::Scenario& s, const Outcome&) {
       return int{s.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive};
     }},
    {"constant delay",
     [](const model::Scenario& s, const Outcome&) {
       return int{s.wireless.kind == model::ServiceKind::constant_delay};
     }},
};

TEST(RandomScenario, SameSeedSameScenario) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(random_scenario(seed), random_scenario(seed));
    EXPECT_NE(random_scenario(seed), random_scenario(seed + 1));
  }
}

TEST(RandomScenario, RunsAreShortAndVaried) {
  std::vector<int> counted(std::size(shares), 0);
  std::uint64_t most_events = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const model::Scenario scenario = random_scenario(seed);
    const Outcome outcome = run(scenario);
    most_events = std::max(most_events, outcome.events);
    EXPECT_LT(outcome.events, 200'000U) << "seed " << seed;
    for (std::size_t k = 0; k < counted.size(); ++k) {
      counted[k] += shares[k].counts(scenario, outcome);
    }
  }
  for (std::size_t k = 0; k < counted.size(); ++k) {
    std::cout << shares[k].name << ": " << counted[k] << " of " << seeds << '\n';
    EXPECT_GT(counted[k], static_cast<int>(seeds / 20)) << shares[k].name;
  }
  std::cout << "most events: " << most_events << '\n';
  EXPECT_GT(counted[0], static_cast<int>(seeds * 35 / 100));
  EXPECT_LT(counted[0], static_cast<int>(seeds * 65 / 100));
}

}  // namespace random_test
}  // namespace stormproof::oracle
