// Compares product and oracle on random scenarios whose participants have different profiles of
// Fast DDS, and the product with itself where all have one, said in another way.
#include <iostream>
#include <string>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/reference.hpp"
#include "model/simulator.hpp"
#include "tests/oracle/comparison.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof::oracle {
namespace random_mixed_test {

constexpr std::uint64_t seeds = 300;

TEST(RandomMixed, ProductAndOracleAgree) {
  int mixed = 0;
  int complete = 0;
  int repaired = 0;
  int looked_up = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const model::Scenario scenario = random_mixed_scenario(seed);
    const auto found = difference(scenario);
    ASSERT_FALSE(found) << "seed " << seed << ": " << *found;
    const FastddsOutcome outcome =
        run_fastdds(scenario, {}, FastddsMistake::none, most_compared_events);
    mixed += is_mixed(scenario) ? 1 : 0;
    complete += outcome.completed ? 1 : 0;
    repaired += outcome.repair_data > 0 ? 1 : 0;
    looked_up += outcome.lookup > 0 ? 1 : 0;
  }
  std::cout << mixed << " mixed, " << complete << " complete, " << repaired << " with repairs, "
            << looked_up << " with lookups of " << seeds << '\n';
  EXPECT_GT(mixed, static_cast<int>(3 * seeds / 4));
  EXPECT_GT(complete, static_cast<int>(seeds / 4));
  EXPECT_GT(repaired, static_cast<int>(seeds / 10));
  EXPECT_GT(looked_up, static_cast<int>(seeds / 20));
}

/// The presets that may stand beside others.
const char* const versions[] = {"fastdds-2.6.11",
                                "fastdds-2.6.11-relations",
                                "fastdds-2.6.11-sndbuf4M",
                                "fastdds-2.9.1",
                                "fastdds-2.14.5",
                                "fastdds-3.2",
                                "fastdds-3.6",
                                "fastdds-static-2.6.11",
                                "cyclonedds-0.10",
                                "cyclonedds-0.10-multicast",
                                "cyclonedds-11"};

void expect_same(const model::Scenario& one, const model::Scenario& other, const char* version) {
  const model::RunResult a = simulate(one);
  const model::RunResult b = simulate(other);
  EXPECT_EQ(a.discovery_time, b.discovery_time) << version;
  EXPECT_EQ(a.end_time, b.end_time) << version;
  EXPECT_EQ(a.events, b.events) << version;
  EXPECT_EQ(a.counts, b.counts) << version;
  EXPECT_EQ(a.user_control, b.user_control) << version;
  EXPECT_EQ(failure_free_reference(one), failure_free_reference(other)) << version;
  EXPECT_EQ(open_loop_airtime(one), open_loop_airtime(other)) << version;
}

/// All participants have the profile; the scenario's own, which nobody has, is another one.
TEST(RandomMixed, OneProfileForEachIsOneForAll) {
  for (const char* version : versions) {
    const auto read = model::config::read_scenario(
        "three-hosts",
        std::vector{std::string{"dds="} + version, std::string{"wireless=emulated-ap"}},
        model::config::SpecPath::standard());
    ASSERT_TRUE(read) << read.error().message;
    const model::Scenario whole = *read;
    model::Scenario each = whole;
    for (model::Participant& one : each.deployment.participants) one.dds = whole.dds;
    EXPECT_FALSE(is_mixed(each)) << version;
    expect_same(whole, each, version);
    each.dds.spdp.startup_announcements += 2;
    each.dds.sedp.heartbeat_period += model::Nanoseconds{70'000'000};
    each.dds.sedp.nack_delay += model::Nanoseconds{7'000'000};
    each.dds.sedp.nack_response_delay += model::Nanoseconds{7'000'000};
    each.dds.sedp.initial_acknack_delay += model::Nanoseconds{7'000'000};
    each.dds.version.statistics_bytes = model::Bytes{40};
    ASSERT_TRUE(is_mixed(each)) << version;
    expect_same(whole, each, version);
  }
}

}  // namespace random_mixed_test
}  // namespace stormproof::oracle
