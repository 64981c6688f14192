// The channel and the source queue inside whole runs: the order of a packet's fragments under every
// service order, the source queue as a limit, separate channels, the constant delay, and losses.
#include "model/engine/network.hpp"

#include <algorithm>
#include <map>

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

/// The services of the first DATA packet as "U0 D0 …": stage and fragment, in order.
std::string services_of_data(const RunLog& log) {
  const std::vector<Sent> data = log.of(PacketKind::data, 0, 1);
  EXPECT_FALSE(data.empty());
  if (data.empty()) return "";
  EXPECT_EQ(data[0].payload_bytes, 460 + 7 * 424);  // 3436 B: three fragments
  std::string text;
  for (const Service& service : log.services) {
    if (service.packet != data[0].number) continue;
    text += (text.empty() ? "" : " ") + std::string{service.stage == 0 ? "U" : "D"} +
            std::to_string(service.fragment);
  }
  return text;
}

std::string services_with(ServiceOrder order, FragmentRequest request) {
  Scenario scenario = three_fragments();
  scenario.wireless.order = order;
  scenario.wireless.fragment_request = request;
  const RunLog log = run_and_log(scenario);
  EXPECT_TRUE(log.result.completed());
  return services_of_data(log);
}

TEST(Network, TheOrderDecidesBetweenTheNextUplinkAndTheForwardedFragment) {
  const auto sequential = FragmentRequest::sequential;
  EXPECT_EQ(services_with(ServiceOrder::fifo_uplink, sequential), "U0 U1 D0 U2 D1 D2");
  EXPECT_EQ(services_with(ServiceOrder::fifo_downlink, sequential), "U0 D0 U1 D1 U2 D2");
  EXPECT_EQ(services_with(ServiceOrder::fifo, sequential), "U0 U1 D0 U2 D1 D2");
  EXPECT_EQ(services_with(ServiceOrder::datagram_uplink, sequential), "U0 U1 U2 D0 D1 D2");
}

TEST(Network, FragmentsRequestedAtAdmissionGoUpTogether) {
  const auto together = FragmentRequest::at_admission;
  for (const ServiceOrder order : {ServiceOrder::fifo_uplink, ServiceOrder::fifo_downlink,
                                   ServiceOrder::fifo, ServiceOrder::datagram_uplink}) {
    EXPECT_EQ(services_with(order, together), "U0 U1 U2 D0 D1 D2");
  }
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

TEST(Network, ReceptionFollowsTheLastFragmentOfTheLastStage) {
  const RunLog log = run_and_log(three_fragments());
  const std::uint64_t number = log.of(PacketKind::data, 0, 1).at(0).number;
  const auto arrival = std::find_if(log.arrived.begin(), log.arrived.end(),
                                    [&](const Arrived& a) { return a.packet == number; });
  ASSERT_NE(arrival, log.arrived.end());
  std::int64_t last = 0;
  for (const Service& service : log.services) {
    if (service.packet == number) last = service.until_ns;
  }
  EXPECT_EQ(arrival->time_ns, last);
}

TEST(Network, AirtimesAreThoseOfTheFormula) {
  const RunLog log = run_and_log(three_fragments());
  std::map<std::pair<PacketKind, std::uint32_t>, std::int64_t> airtime;
  for (const Service& s : log.services) {
    if (s.fragment == 0) airtime[{s.kind, s.stage}] = s.until_ns - s.from_ns;
  }
  EXPECT_EQ((airtime[{PacketKind::spdp_multicast, 0}]), 194'500 + 26'925);   // 486 B, unicast
  EXPECT_EQ((airtime[{PacketKind::spdp_multicast, 1}]), 130'500 + 648'000);  // 486 B, multicast
  EXPECT_EQ((airtime[{PacketKind::heartbeat, 0}]), 194'500 + 7'424);         // 134 B
  EXPECT_EQ((airtime[{PacketKind::heartbeat, 1}]), 194'500 + 7'424);
}

TEST(Network, TheSourceQueueLimitsWhatIsAdmitted) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 10);
  scenario.wireless.source_queue_bytes = Bytes{4'000};
  const RunLog log = run_and_log(scenario);
  EXPECT_TRUE(log.result.completed());
  // A packet of 30 descriptors alone exceeds 4,000 B, so it is admitted to an empty queue only.
  const std::int64_t largest = Fragmentation{scenario.wireless}.demand(452 + 14 * 456 + 32, 5);
  EXPECT_LE(log.most_admitted_bytes, 4 * std::max<std::int64_t>(4'000, largest));
  EXPECT_GT(log.result.backlog.at(0).packets, 0U);
}

TEST(Network, WithAQueueOfOneByteEachPacketIsAdmittedAlone) {
  Scenario scenario = three_fragments();
  scenario.wireless.source_queue_bytes = Bytes{1};
  const RunLog log = run_and_log(scenario);
  EXPECT_TRUE(log.result.completed());
  std::map<std::uint64_t, std::uint32_t> source_of;
  for (const Sent& packet : log.sent) source_of[packet.number] = packet.source;
  // Uplink services of one source: no fragment of a packet before the last fragment of the one
  // before it.
  std::map<std::uint32_t, std::vector<std::uint64_t>> uplinks;
  for (const Service& s : log.services) {
    if (s.stage == 0) uplinks[source_of.at(s.packet)].push_back(s.packet);
  }
  ASSERT_EQ(uplinks.size(), 2U);
  for (const auto& [source, packets] : uplinks) {
    EXPECT_TRUE(std::is_sorted(packets.begin(), packets.end())) << source;
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

TEST(Network, ConstantDelayDeliversEachPacketAfterOneWay) {
  const RunLog log = run_and_log(by_hand({{0, 2}, {1, 3}}, 7 * us));
  ASSERT_FALSE(log.arrived.empty());
  std::map<std::uint64_t, std::int64_t> emitted;
  for (const Sent& packet : log.sent) emitted[packet.number] = packet.time_ns;
  for (const Arrived& a : log.arrived) EXPECT_EQ(a.time_ns, emitted.at(a.packet) + 7 * us);
  EXPECT_TRUE(log.services.empty());
  EXPECT_TRUE(log.result.channels.empty());
}

TEST(Network, WithoutAnyDelayDiscoveryTakesNoTime) {
  const RunLog log = run_and_log(by_hand({{0, 2}, {1, 3}}, 0));
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{0});
  EXPECT_EQ(log.result.counts.initial_data, 5U);
}

TEST(Network, ALostPacketIsServedButNotReceived) {
  Scenario scenario = three_fragments();
  const std::uint64_t number = run_and_log(scenario).of(PacketKind::data, 0, 1).at(0).number;
  lose(scenario, number, number + 1);
  const RunLog log = run_and_log(scenario);
  EXPECT_TRUE(log.result.completed());
  EXPECT_EQ(services_of_data(log), "U0 U1 D0 U2 D1 D2");
  EXPECT_EQ(std::count_if(log.arrived.begin(), log.arrived.end(),
                          [](const Arrived& a) { return a.lost; }),
            1);
  EXPECT_EQ(log.result.counts.initial_data, 9U);
  EXPECT_EQ(log.result.counts.repair_data, 8U);
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
