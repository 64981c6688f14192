// The network inside whole runs: it never idles without need, separate channels serve at the same
// time, and records that stand for several packets change nothing.
#include "model/engine/network.hpp"

#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace network_test {

/// One participant on each of two hosts; the first has enough publications for a DATA packet of
/// three fragments.
Scenario three_fragments() {
  Scenario scenario = by_hand({{0, 8}, {1, 1}});
  scenario.wireless = WirelessProfile{};
  return scenario;
}

TEST(Network, AChannelServesOneFragmentAtATimeAndNeverIdlesWithoutNeed) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 10);
  const RunLog log = run_and_log(scenario);
  ASSERT_GT(log.services.size(), 500U);
  for (std::size_t k = 1; k < log.services.size(); ++k) {
    EXPECT_GE(log.services[k].from_ns, log.services[k - 1].until_ns);
  }
  // A busy period: from the first service on, the next one starts the instant the last one ends.
  for (std::size_t k = 1; k < 500; ++k) {
    EXPECT_EQ(log.services[k].from_ns, log.services[k - 1].until_ns) << k;
  }
}

TEST(Network, StagesOnDifferentChannelsServeAtTheSameTime) {
  Scenario scenario = three_fragments();
  scenario.wireless.stages[1].channel = "down";
  const RunLog log = run_and_log(scenario);
  EXPECT_TRUE(log.result.completed());
  ASSERT_EQ(log.result.channels.size(), 2U);
  bool overlap = false;
  for (const Service& a : log.services) {
    for (const Service& b : log.services) {
      overlap =
          overlap || (a.channel != b.channel && a.from_ns < b.until_ns && b.from_ns < a.until_ns);
    }
  }
  EXPECT_TRUE(overlap);
}

/// Whoever hears of packets hears of each; otherwise HEARTBEATs to many readers are one record.
TEST(Network, ARunIsTheSameWhetherSomebodyHearsOfItOrNot) {
  for (const ImplementationKind kind : {ImplementationKind::paper, ImplementationKind::fastdds}) {
    for (const Bytes queue : {Bytes{3'000}, WirelessProfile::unlimited}) {
      for (const ServiceOrder order : {ServiceOrder::fifo_uplink, ServiceOrder::fifo_downlink,
                                       ServiceOrder::fifo, ServiceOrder::datagram_uplink}) {
        Scenario scenario;
        scenario.deployment = Deployment::homogeneous(2, 3, 6);
        scenario.dds.implementation = kind;
        scenario.wireless.source_queue_bytes = queue;
        scenario.wireless.order = order;
        scenario.wireless.lost_packets = {7, 8, 30, 31, 55, 90};
        const RunResult heard = run_and_log(scenario).result;
        const RunResult alone = simulate(scenario);
        EXPECT_EQ(alone.events, heard.events);
        EXPECT_EQ(alone.end_time, heard.end_time);
        EXPECT_EQ(alone.counts, heard.counts);
        EXPECT_EQ(alone.duplicate_deliveries, heard.duplicate_deliveries);
        for (std::size_t k = 0; k < traffic_class_count; ++k) {
          EXPECT_EQ(alone.latency[k].packets, heard.latency[k].packets);
          EXPECT_EQ(alone.latency[k].backlog_sum, heard.latency[k].backlog_sum);
          EXPECT_EQ(alone.latency[k].service_sum, heard.latency[k].service_sum);
        }
        for (std::size_t i = 0; i < heard.backlog.size(); ++i) {
          EXPECT_EQ(alone.backlog[i].packets, heard.backlog[i].packets);
          EXPECT_EQ(alone.backlog[i].at, heard.backlog[i].at);
        }
      }
    }
  }
}

TEST(Network, PacketNumbersCountCopiesOneByOne) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(3, 2, 3);
  scenario.time_limit = Nanoseconds{300 * ms};
  const RunLog log = run_and_log(scenario);
  ASSERT_GT(log.sent.size(), 200U);
  for (std::size_t k = 0; k < log.sent.size(); ++k) ASSERT_EQ(log.sent[k].number, k);
}

}  // namespace network_test
}  // namespace stormproof::model
