// Compares product and oracle on random scenarios with what later versions of Fast DDS have: their
// order of matching, sizes, messages and charge, and the endpoints that look up types. Also judges
// these scenarios: a comparison on runs that never finish or never repair would prove little.
#include <iostream>

#include <gtest/gtest.h>

#include "tests/oracle/comparison.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof::oracle {
namespace random_versions_test {

constexpr std::uint64_t seeds = 400;

TEST(RandomVersions, ProductAndOracleAgree) {
  int complete = 0;
  int repaired = 0;
  int in_a_group = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const model::Scenario scenario = random_version_scenario(seed);
    const auto found = difference(scenario);
    ASSERT_FALSE(found) << "seed " << seed << ": " << *found;
    const FastddsOutcome outcome =
        run_fastdds(scenario, {}, FastddsMistake::none, most_compared_events);
    complete += outcome.completed ? 1 : 0;
    repaired += outcome.repair_data > 0 ? 1 : 0;
    const bool group = scenario.dds.sedp.piggyback == model::Piggyback::group;
    in_a_group += group && outcome.piggybacks > 0 ? 1 : 0;
  }
  std::cout << complete << " complete, " << repaired << " with repairs, " << in_a_group
            << " with HEARTBEATs by group of " << seeds << '\n';
  EXPECT_GT(complete, static_cast<int>(seeds / 4));
  EXPECT_GT(repaired, static_cast<int>(seeds / 10));
  EXPECT_GT(in_a_group, static_cast<int>(seeds / 20));
}

TEST(RandomVersions, ProductAndOracleAgreeOnLookups) {
  int complete = 0;
  int looked_up = 0;
  int on_time = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const model::Scenario scenario = random_lookup_scenario(seed);
    const auto found = difference(scenario);
    ASSERT_FALSE(found) << "seed " << seed << ": " << *found;
    const FastddsOutcome outcome =
        run_fastdds(scenario, {}, FastddsMistake::none, most_compared_events);
    complete += outcome.completed ? 1 : 0;
    looked_up += outcome.lookup > 0 ? 1 : 0;
    on_time += outcome.completed && outcome.lookup > 0 ? 1 : 0;
  }
  std::cout << complete << " complete, " << looked_up << " with lookups, " << on_time
            << " with both of " << seeds << '\n';
  EXPECT_GT(looked_up, static_cast<int>(seeds / 2));
  EXPECT_GT(on_time, static_cast<int>(seeds / 5));
}

}  // namespace random_versions_test
}  // namespace stormproof::oracle
