// The keys of `service: unit`, `sender` and `count_at`: their defaults, and what is an error with
// which service and which implementation, with its place and what was expected.
#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace wifi_keys_test {

/// Line 5 begins with the first of `keys`.
Result<Scenario> read(const std::string& keys, const std::string& dds = "fastdds-2.6.11",
                      const std::string& kind = "shared_channel") {
  const std::string text =
      "deployment: {hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}\n"
      "dds: " +
      dds + "\ntime_limit: 60s\nwireless:\n" + keys +
      "  overhead_unicast: 194.5us\n  overhead_multicast: 130.5us\n"
      "  rate_unicast: 144.4Mbps\n  rate_multicast: 6Mbps\n  link_overhead_bytes: 38\n"
      "  mtu_payload_bytes: 1480\n  source_queue_bytes: 212992\n  kind: " +
      kind + "\n";
  TestFiles files;
  return read_scenario(files.write("wifi.yaml", text), {}, source_specs());
}

const std::string unit = "  service: unit\n";
const std::string stages =
    "  stages: [{name: hop, channel: air, multicast_as: multicast}]\n  fragment_request: "
    "at_admission\n  order: fifo\n";

std::string error_of(const Result<Scenario>& result) {
  return result ? "no error" : to_string(result.error());
}

TEST(WifiKeys, EverythingOfUnitsHasADefault) {
  const auto scenario = read(unit);
  ASSERT_TRUE(scenario) << error_of(scenario);
  const WirelessProfile& w = scenario->wireless;
  EXPECT_EQ(w.service, ServedBy::unit);
  EXPECT_EQ(w.aggregation,
            (Aggregation{64, Bytes{65'535}, Nanoseconds{5'484'000}, Nanoseconds{198'500}}));
  EXPECT_EQ(w.arbitration, Arbitration::round_robin);
  EXPECT_EQ(w.ap_queue, ApQueue::oldest);
  EXPECT_EQ(w.queueing, Queueing::fifo);
  EXPECT_EQ(w.quantum, Bytes{300});
  EXPECT_EQ(w.sender, Sender::backlog);
  EXPECT_EQ(w.count_at, CountAt::generation);
  EXPECT_EQ(w.fragment_request, FragmentRequest::at_admission);
}

TEST(WifiKeys, EachCanBeSet) {
  const auto scenario =
      read(unit +
           "  aggregation: {max_frames: 4, max_airtime: 20us}\n  queueing: flows\n  quantum: 100\n"
           "  ap_queue: round_robin\n  sender: stalls\n  count_at: admission\n"
           "  fragment_request: at_admission\n");
  ASSERT_TRUE(scenario) << error_of(scenario);
  EXPECT_EQ(scenario->wireless.aggregation.max_frames, 4U);
  EXPECT_EQ(scenario->wireless.aggregation.max_bytes, Bytes{65'535});
  EXPECT_EQ(scenario->wireless.sender, Sender::stalls);
  EXPECT_EQ(scenario->wireless.count_at, CountAt::admission);
  // What is written is read again.
  EXPECT_NE(effective_yaml(*scenario).find("service: unit"), std::string::npos);
}

TEST(WifiKeys, FramesHaveSenderAndCountsToo) {
  const auto scenario = read(stages + "  sender: stalls\n  count_at: admission\n");
  ASSERT_TRUE(scenario) << error_of(scenario);
  EXPECT_EQ(scenario->wireless.service, ServedBy::frame);
  EXPECT_EQ(scenario->wireless.sender, Sender::stalls);
}

struct Bad {
  std::string keys;
  std::string dds;
  std::string kind;
  std::string place;
  std::string says;
};

class BadWifiKeys : public testing::TestWithParam<Bad> {};

TEST_P(BadWifiKeys, AreAnErrorWithItsPlace) {
  const Bad& bad = GetParam();
  const std::string error = error_of(read(bad.keys, bad.dds, bad.kind));
  EXPECT_NE(error.find(bad.place), std::string::npos) << error;
  EXPECT_NE(error.find(bad.says), std::string::npos) << error;
}

const std::string fast = "fastdds-2.6.11";
const std::string shared = "shared_channel";
INSTANTIATE_TEST_SUITE_P(
    All, BadWifiKeys,
    testing::Values(
        Bad{unit + stages, fast, shared, ":6:3", "wireless.stages: only service: frame"},
        Bad{unit + "  order: fifo\n", fast, shared, ":6:3", "wireless.order: only service: frame"},
        Bad{unit, fast, "constant_delay", ":13:9", "wireless.kind: 'constant_delay'; expected"},
        Bad{unit + "  fragment_request: sequential\n", fast, shared, ":6:21",
            "expected at_admission"},
        Bad{unit + "  queueing: flows\n  arbitration: oldest\n", fast, shared, ":7:16",
            "expected round_robin"},
        Bad{unit + "  ap_queue: round_robin\n  arbitration: oldest\n", fast, shared, ":7:16",
            "expected round_robin"},
        Bad{unit + "  aggregation: {frames: 2}\n", fast, shared, ":6:17", "unknown key 'frames'"},
        Bad{unit, "paper", shared, ":5:12", "wireless.service: 'unit'; expected frame"},
        Bad{stages + "  sender: stalls\n", "paper", shared, ":8:11",
            "wireless.sender: 'stalls'; expected backlog"},
        Bad{stages + "  count_at: admission\n", "paper", shared, ":8:13",
            "wireless.count_at: 'admission'; expected generation"},
        Bad{stages + "  aggregation: {}\n", fast, shared, ":8:3", "only service: unit"},
        Bad{stages + "  arbitration: oldest\n", fast, shared, ":8:3", "only service: unit"},
        Bad{stages + "  ap_queue: oldest\n", fast, shared, ":8:3", "only service: unit"},
        Bad{stages + "  queueing: fifo\n", fast, shared, ":8:3", "only service: unit"},
        Bad{stages + "  quantum: 300\n", fast, shared, ":8:3", "only service: unit"}));

}  // namespace wifi_keys_test
}  // namespace stormproof::model::config
