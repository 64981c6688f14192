// Direction and size of the changes that users make to a way to discover, on the deployment of the
// live measurements. What was measured there: HeartbeatInterval 1 s takes Cyclone DDS at 5×20 from
// 3.50 s and 14,811 messages to 0.77 s and 3,254.
#include <gtest/gtest.h>

#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::compare {
namespace changes_test {

struct Medians {
  double completion_s = 0, messages = 0, repairs = 0, announcements = 0;
};

Medians medians(std::vector<std::string> changes) {
  changes.emplace_back("time_limit=60s");
  const auto scenario =
      model::config::read_scenario("live-5x20", changes, {{STORMPROOF_SPECS_DIR}});
  EXPECT_TRUE(scenario) << to_string(scenario.error());
  if (!scenario) return {};
  trials::SampleOptions options;
  options.samples = 9;
  std::vector<double> completion, messages, repairs, announcements;
  for (const trials::Sample& run : trials::sample_runs(*scenario, options)) {
    completion.push_back(statistics::completion_ns(run.discovery_time) / 1e9);
    messages.push_back(static_cast<double>(run.counts.total()));
    repairs.push_back(static_cast<double>(run.counts.repair_data));
    announcements.push_back(static_cast<double>(run.counts.spdp()));
  }
  return {statistics::median(completion), statistics::median(messages), statistics::median(repairs),
          statistics::median(announcements)};
}

TEST(ChangesOfDiscovery, CycloneWithRarerHeartbeatsTakesAQuarterOfTimeAndMessages) {
  const Medians before = medians({"dds=cyclonedds-0.10"});
  const Medians after = medians({"dds=cyclonedds-0.10", "dds.sedp.heartbeat_interval=1s"});
  EXPECT_LT(after.completion_s, 0.45 * before.completion_s);
  EXPECT_GT(after.completion_s, 0.1 * before.completion_s);
  EXPECT_NEAR(after.completion_s, 0.77, 0.3) << "as measured";
  EXPECT_NEAR(after.messages, 3'254, 700) << "as measured";
  EXPECT_LT(after.messages, 0.4 * before.messages);
}

TEST(ChangesOfDiscovery, CycloneThatAsksAgainLaterIsQuicker) {
  const Medians before = medians({"dds=cyclonedds-0.10"});
  const Medians after = medians({"dds=cyclonedds-0.10", "dds.sedp.nack_delay=1s"});
  EXPECT_LT(after.completion_s, before.completion_s);
  EXPECT_LT(after.messages, before.messages);
}

TEST(ChangesOfDiscovery, AServerWithShorterPeriodsHasALowerFloor) {
  const std::vector<std::string> small{"dds=fastdds-server-2.6.11",
                                       "deployment.participants_per_host=1",
                                       "deployment.endpoints_per_participant=2"};
  std::vector<std::string> quick = small;
  quick.insert(quick.end(), {"dds.client_sync_period=50ms", "dds.server_routine_period=50ms"});
  const Medians before = medians(small);
  const Medians after = medians(quick);
  EXPECT_GT(before.completion_s, 0.9);
  EXPECT_LT(after.completion_s, 0.5 * before.completion_s);
}

TEST(ChangesOfDiscovery, Version2145RelaysOnceAndRepairsLess) {
  const std::vector<std::string> super{"dds.discovery=super_client",
                                       "deployment.participants_per_host=3"};
  std::vector<std::string> before{"dds=fastdds-server-2.6.11"};
  std::vector<std::string> after{"dds=fastdds-server-2.14.5"};
  before.insert(before.end(), super.begin(), super.end());
  after.insert(after.end(), super.begin(), super.end());
  EXPECT_LT(medians(after).repairs, 0.5 * medians(before).repairs);
}

TEST(ChangesOfDiscovery, ThirtyTwoPeerPortsCostAnnouncements) {
  const std::vector<std::string> peers{"dds=fastdds-static-2.6.11",
                                       "deployment.participants_per_host=3", "dds.peer_ports=4"};
  std::vector<std::string> more = peers;
  more.back() = "dds.peer_ports=32";
  const Medians before = medians(peers);
  const Medians after = medians(more);
  EXPECT_GT(after.announcements, 3 * before.announcements);
  EXPECT_GT(after.completion_s, before.completion_s);
}

}  // namespace changes_test
}  // namespace stormproof::compare
