// Judges the generator of random scenarios of `implementation: fastdds`: a comparison on scenarios
// that never finish, never repair or all look alike would prove little. The shares are printed, so
// that a change of the generator shows what it did.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "tests/oracle/fastdds_oracle.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::oracle {
namespace random_fastdds_test {

constexpr std::uint64_t seeds = 400;

using model::Scenario;

bool has_same_host_pair(const Scenario& s) {
  return s.deployment.host_count() < s.deployment.size();
}

struct Share {
  const char* name;
  bool (*counts)(const Scenario&, const FastddsOutcome&);
};

constexpr Share shares[] = {
    {"complete", [](const Scenario&, const FastddsOutcome& o) { return o.completed; }},
    {"with repairs", [](const Scenario&, const FastddsOutcome& o) { return o.repair_data > 0; }},
    {"complete, with repairs",
     [](const Scenario&, const FastddsOutcome& o) { return o.completed && o.repair_data > 0; }},
    {"with piggyback", [](const Scenario&, const FastddsOutcome& o) { return o.piggybacks > 0; }},
    {"with piggyback in a new message",
     [](const Scenario&, const FastddsOutcome& o) { return o.replaced_messages > 0; }},
    {"with user control",
     [](const Scenario&, const FastddsOutcome& o) { return o.user_control > 0; }},
    {"with a lost packet",
     [](const Scenario& s, const FastddsOutcome& o) {
       const auto& lost = s.wireless.lost_packets;
       return !lost.empty() && lost.front() < o.packets;
     }},
    {"with a same-host pair",
     [](const Scenario& s, const FastddsOutcome&) { return has_same_host_pair(s); }},
    {"adaptive",
     [](const Scenario& s, const FastddsOutcome&) {
       return s.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
     }},
    {"constant delay",
     [](const Scenario& s, const FastddsOutcome&) {
       return s.wireless.kind == model::ServiceKind::constant_delay;
     }},
};

TEST(RandomFastddsScenario, SameSeedSameScenario) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(random_fastdds_scenario(seed), random_fastdds_scenario(seed));
    EXPECT_NE(random_fastdds_scenario(seed), random_fastdds_scenario(seed + 1));
  }
}

TEST(RandomFastddsScenario, RunsAreShortAndVaried) {
  std::vector<int> counted(std::size(shares), 0);
  std::uint64_t most_events = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Scenario scenario = random_fastdds_scenario(seed);
    const FastddsOutcome outcome = run_fastdds(scenario);
    most_events = std::max(most_events, outcome.events);
    EXPECT_LT(outcome.events, 200'000U) << "seed " << seed;
    for (std::size_t k = 0; k < counted.size(); ++k) {
      if (shares[k].counts(scenario, outcome)) ++counted[k];
    }
  }
  for (std::size_t k = 0; k < counted.size(); ++k) {
    std::cout << shares[k].name << ": " << counted[k] << " of " << seeds << '\n';
    EXPECT_GT(counted[k], static_cast<int>(seeds / 20)) << shares[k].name;
  }
  std::cout << "most events: " << most_events << '\n';
  EXPECT_GT(counted[0], static_cast<int>(seeds * 30 / 100));
  EXPECT_LT(counted[0], static_cast<int>(seeds * 70 / 100));
}

}  // namespace random_fastdds_test
}  // namespace stormproof::oracle
