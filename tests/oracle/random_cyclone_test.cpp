// Judges the generator of random scenarios of `implementation: cyclone`, as random_fastdds_test.cpp
// does: a comparison on scenarios that never finish, never repair or all look alike would prove
// little.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "props/generators/on_demand.hpp"
#include "tests/oracle/comparison.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::oracle {
namespace random_cyclone_test {

constexpr std::uint64_t seeds = 300;

using model::Scenario;

struct Share {
  const char* name;
  bool (*counts)(const Scenario&, const CycloneOutcome&);
};

constexpr Share shares[] = {
    {"complete", [](const Scenario&, const CycloneOutcome& o) { return o.completed; }},
    {"with repairs", [](const Scenario&, const CycloneOutcome& o) { return o.repair_data > 0; }},
    {"with multicast",
     [](const Scenario& s, const CycloneOutcome&) {
       return s.dds.allow_multicast == model::AllowMulticast::always;
     }},
    {"with a lost packet",
     [](const Scenario& s, const CycloneOutcome& o) {
       const auto& lost = s.wireless.lost_packets;
       return !lost.empty() && lost.front() < o.packets;
     }},
    {"with a same-host pair",
     [](const Scenario& s, const CycloneOutcome&) {
       return s.deployment.host_count() < s.deployment.size();
     }},
    {"with somebody who is busy at first",
     [](const Scenario& s, const CycloneOutcome&) {
       return std::ranges::any_of(s.deployment.participants,
                                  [](const auto& p) { return p.ready.has_value(); });
     }},
    {"without merging",
     [](const Scenario& s, const CycloneOutcome&) {
       return s.dds.sedp.merge_queued_rexmit == model::MergeQueued::no;
     }},
    {"told in order",
     [](const Scenario& s, const CycloneOutcome&) {
       return s.dds.sedp.notification == model::Notification::in_order;
     }},
    {"sending takes no time",
     [](const Scenario& s, const CycloneOutcome&) {
       return s.deployment.time_to_send() == model::Nanoseconds{0};
     }},
    {"constant delay",
     [](const Scenario& s, const CycloneOutcome&) {
       return s.wireless.kind == model::ServiceKind::constant_delay;
     }},
};

TEST(RandomCycloneScenario, SameSeedSameScenario) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(random_cyclone_scenario(seed), random_cyclone_scenario(seed));
    EXPECT_NE(random_cyclone_scenario(seed), random_cyclone_scenario(seed + 1));
  }
}

TEST(RandomCycloneScenario, RunsAreVaried) {
  std::vector<int> counted(std::size(shares), 0);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Scenario scenario = random_cyclone_scenario(seed);
    const CycloneOutcome outcome =
        run_cyclone(scenario, {}, CycloneMistake::none, most_compared_events);
    for (std::size_t k = 0; k < counted.size(); ++k) {
      if (shares[k].counts(scenario, outcome)) ++counted[k];
    }
  }
  for (std::size_t k = 0; k < counted.size(); ++k) {
    std::cout << shares[k].name << ": " << counted[k] << " of " << seeds << '\n';
    EXPECT_GT(counted[k], static_cast<int>(seeds / 20)) << shares[k].name;
    EXPECT_LT(counted[k], static_cast<int>(seeds * 19 / 20)) << shares[k].name;
  }
}

TEST(RandomCycloneScenario, ProductAndOracleAgree) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const auto found = difference(random_cyclone_scenario(seed));
    EXPECT_FALSE(found) << "seed " << seed << ": " << *found;
  }
}

TEST(RandomCycloneScenario, ProductAndOracleAgreeOnThreadsThatTakeTime) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Scenario scenario = random_cyclone_scenario(seed);
    props::Dice dice{seed};
    props::draw_processor(dice, scenario);
    const auto found = difference(scenario);
    EXPECT_FALSE(found) << "seed " << seed << ": " << *found;
  }
}

}  // namespace random_cyclone_test
}  // namespace stormproof::oracle
