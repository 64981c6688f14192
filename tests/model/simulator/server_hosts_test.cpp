// A Discovery Server on hosts as Linux makes them: what is counted at admission is what is
// generated, if there is room for everything, and a sender that stalls still discovers.
#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"

namespace stormproof::model {
namespace server_hosts_test {

RunResult run(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"dds=fastdds-server-2.6.11", "wireless=wifi-80211n",
                                       "deployment.participants_per_host=2"});
  const auto scenario =
      config::read_scenario("wifi-5x20-fastdds", overrides, {{STORMPROOF_SPECS_DIR}});
  EXPECT_TRUE(scenario) << to_string(scenario.error());
  return simulate(*scenario);
}

TEST(ServerHosts, WithRoomForEverythingAdmissionCountsWhatIsGenerated) {
  const std::vector<std::string> roomy{"wireless.sender=backlog",
                                       "wireless.source_queue_bytes=100000000"};
  std::vector<std::string> admitted = roomy;
  admitted.emplace_back("wireless.count_at=admission");
  const RunResult generated = run(roomy);
  ASSERT_TRUE(generated.completed());
  EXPECT_GT(generated.counts.pdp_data, 0U);
  EXPECT_GT(generated.counts.gap, 0U);
  EXPECT_EQ(run(admitted).counts, generated.counts);
}

TEST(ServerHosts, ASenderThatStallsStillDiscovers) {
  const RunResult stalled = run({"wireless.sender=stalls", "wireless.source_queue_bytes=2000"});
  EXPECT_TRUE(stalled.completed());
  const RunResult waiting = run({"wireless.sender=backlog", "wireless.source_queue_bytes=2000"});
  EXPECT_NE(stalled.counts, waiting.counts) << "nothing was held";
}

}  // namespace server_hosts_test
}  // namespace stormproof::model
