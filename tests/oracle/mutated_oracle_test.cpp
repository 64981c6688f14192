// The oracles with deliberate mistakes: the comparison with the product notices every one of them.
// What it could not notice, it would not notice in the product either.
#include <iostream>

#include <gtest/gtest.h>

#include "tests/model/packet_feed.hpp"
#include "tests/oracle/judged_runs.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof::oracle {
namespace mutated_oracle_test {

constexpr std::size_t tries = 1'000;

Observed correct_product(const model::Scenario& scenario, std::uint64_t max_events) {
  return observe_product(scenario, nullptr, max_events);
}

/// Looks for a scenario on which each mistake shows; returns those that show on none.
template <class SomeMistake>
std::vector<std::string> unnoticed(JudgedRuns& runs, std::size_t count, std::size_t first = 1) {
  std::vector<std::string> list;
  std::size_t most = 0;
  for (std::size_t k = first; k < count; ++k) {
    const auto mistake = static_cast<SomeMistake>(k);
    const std::size_t needed = runs.tries_until(tries, [&](const JudgedRun& run) {
      // A run that is longer than the product's differs already.
      const std::uint64_t enough = processed(run.correct) + 1;
      const Observed wrong = observe_oracle(run.scenario, mistake, enough);
      return first_difference(run.correct, wrong).has_value();
    });
    if (needed > tries) list.emplace_back(name_of(mistake));
    most = std::max(most, needed);
  }
  std::cout << count - first << " mistakes, noticed after at most " << most << " scenarios\n";
  return list;
}

TEST(MutatedOracle, EveryMistakeOfThePaperOracleIsNoticed) {
  JudgedRuns runs{varied_scenario, correct_product};
  EXPECT_EQ(unnoticed<Mistake>(runs, first_mistake_of_life), std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeOfTheFastddsOracleIsNoticed) {
  JudgedRuns runs{varied_fastdds_scenario, correct_product};
  EXPECT_EQ(unnoticed<FastddsMistake>(runs, first_fastdds_mistake_of_life),
            std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeAboutLaterVersionsIsNoticed) {
  JudgedRuns runs{varied_version_scenario, correct_product};
  EXPECT_EQ(unnoticed<FastddsMistake>(runs, first_fastdds_mistake_of_lookups,
                                      first_fastdds_mistake_of_versions),
            std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeAboutLookupsIsNoticed) {
  JudgedRuns runs{random_lookup_scenario, correct_product};
  EXPECT_EQ(
      unnoticed<FastddsMistake>(runs, fastdds_mistake_count, first_fastdds_mistake_of_lookups),
      std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeOfTheServerOracleIsNoticed) {
  JudgedRuns runs{varied_server_scenario, correct_product};
  EXPECT_EQ(unnoticed<ServerMistake>(runs, server_mistake_count), std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeOfTheCycloneOracleIsNoticed) {
  JudgedRuns runs{varied_cyclone_scenario, correct_product};
  EXPECT_EQ(unnoticed<CycloneMistake>(runs, cyclone_mistake_count), std::vector<std::string>{});
}

/// Those that the channel makes are noticed in lists of packets; those of senders in runs.
TEST(MutatedOracle, EveryMistakeOfTheWifiOracleIsNoticed) {
  JudgedRuns runs{varied_wifi_scenario, correct_product};
  const auto last = static_cast<std::size_t>(last_of_one_access_point);
  EXPECT_EQ(unnoticed<WifiMistake>(runs, last + 1), std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeOfTheFleetOracleIsNoticed) {
  JudgedRuns runs{varied_fleet_scenario, correct_product};
  const auto first = static_cast<std::size_t>(last_of_one_access_point) + 1;
  EXPECT_EQ(unnoticed<WifiMistake>(runs, first_wifi_mistake_of_queues, first),
            std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeOfQueuesIsNoticed) {
  JudgedRuns runs{varied_queue_scenario, correct_product};
  EXPECT_EQ(unnoticed<WifiMistake>(runs, wifi_mistake_count, first_wifi_mistake_of_queues),
            std::vector<std::string>{});
}

/// Of the mistakes from the first one until before the end.
std::vector<std::string> unnoticed_in_lists(PacketList (*list_of)(std::uint64_t), std::size_t first,
                                            std::size_t end) {
  std::vector<std::string> unnoticed;
  for (std::size_t k = first; k < end; ++k) {
    const auto mistake = static_cast<WifiMistake>(k);
    bool noticed = false;
    for (std::uint64_t seed = 0; seed < tries && !noticed; ++seed) {
      const PacketList list = list_of(seed);
      noticed = arrivals(list.wireless, list.hosts, list.packets) !=
                feed_units(list.wireless, list.hosts, list.packets, mistake);
    }
    if (!noticed) unnoticed.emplace_back(name_of(mistake));
  }
  return unnoticed;
}

TEST(MutatedOracle, EveryMistakeOfTheChannelIsNoticedInListsOfPackets) {
  const auto last = static_cast<std::size_t>(WifiMistake::returned_frame_in_flow);
  EXPECT_EQ(unnoticed_in_lists(random_packet_list, 1, last + 1), std::vector<std::string>{});
}

TEST(MutatedOracle, EveryMistakeOfQueuesIsNoticedInListsOfPackets) {
  EXPECT_EQ(unnoticed_in_lists(random_queue_list, first_wifi_mistake_of_queues, wifi_mistake_count),
            std::vector<std::string>{});
}

TEST(MutatedOracle, MistakesHaveNames) {
  EXPECT_EQ(name_of(Mistake::none), "none");
  EXPECT_EQ(name_of(Mistake::class_ignored), "class_ignored");
  EXPECT_EQ(name_of(FastddsMistake::response_with_old_base), "response_with_old_base");
  EXPECT_EQ(name_of(WifiMistake::counted_at_generation), "counted_at_generation");
  EXPECT_EQ(name_of(CycloneMistake::answers_undirected), "answers_undirected");
  EXPECT_EQ(name_of(ServerMistake::gaps_cost_nothing), "gaps_cost_nothing");
}

}  // namespace mutated_oracle_test
}  // namespace stormproof::oracle
