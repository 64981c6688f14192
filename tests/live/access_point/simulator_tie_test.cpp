// The access point against the simulator: the frames of a simulated run, requested at the same
// times, are served from the same to the same nanosecond, in the same order.
#include <algorithm>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "tests/live/access_point/half_duplex_channel.hpp"
#include "tests/live/access_point/serving_profile.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::live {
namespace simulator_tie_test {

using model::RunLog;
using model::Scenario;

Scenario scenario(const std::string& deployment, const std::string& dds,
                  const std::string& wireless) {
  const std::string text = "deployment: " + deployment + "\ndds: " + dds +
                           "\nwireless: " + wireless + "\ntime_limit: 2s\n";
  auto read =
      model::config::parse_scenario(text, "test.yaml", {}, model::config::SpecPath::standard());
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  return read ? *read : Scenario{};
}

constexpr const char* emulated = "emulated-ap";
constexpr const char* five_by_twenty =
    "{hosts: 2, participants_per_host: 5, endpoints_per_participant: 20}";

/// As the kernel tells conversations apart (specs/guide/wifi.md, "Flows").
model::Flow flow_of(const model::Sent& packet, std::int64_t fragments) {
  if (fragments > 1) {
    const bool to_all = packet.destination == model::Sent::everybody;
    return {.by_host = true, .destination = to_all ? model::Flow::everybody : 0};
  }
  return {.source = packet.source, .destination = packet.destination, .port = packet.port};
}

/// Feeds the packets of the run into an access point as the kernel would: all fragments at once.
std::vector<model::Service> served_again(const RunLog& run, const Scenario& simulated,
                                         const model::WirelessProfile& wireless) {
  const model::Fragmentation fragmentation{simulated.wireless};
  const std::int64_t link_overhead = simulated.wireless.link_overhead_bytes.count();
  HalfDuplexChannel channel{wireless, {}, {}};
  struct Origin {
    const model::Sent* packet;
    std::uint32_t fragment;
  };
  std::vector<Origin> origins;  // by the channel's name of the frame; none is used twice
  for (const model::Sent& packet : run.sent) {
    const Cast cast =
        packet.kind == model::PacketKind::spdp_multicast ? Cast::multicast : Cast::unicast;
    const std::int64_t fragments = fragmentation.count(packet.payload_bytes);
    for (std::int64_t k = 0; k < fragments; ++k) {
      const std::int64_t bytes =
          fragmentation.bytes(packet.payload_bytes, k) - link_overhead + ethernet_header_bytes;
      const std::uint32_t host = simulated.deployment.participants[packet.source].host.value;
      const auto name = channel.request(Nanoseconds{packet.time_ns},
                                        {host, bytes, cast, flow_of(packet, fragments)});
      EXPECT_TRUE(name);
      origins.resize(std::max<std::size_t>(origins.size(), *name + 1));
      origins[*name] = {&packet, static_cast<std::uint32_t>(k)};
    }
  }
  channel.advance(Nanoseconds{std::int64_t{1} << 60U});
  std::vector<model::Service> services;
  for (const Service& service : channel.take_services()) {
    if (service.outcome == ServiceEnd::dropped) continue;
    const Origin& origin = origins[service.frame];
    services.push_back({service.start.count(), service.end.count(), 0,
                        static_cast<std::uint32_t>(service.direction), origin.fragment,
                        origin.packet->number, origin.packet->kind});
  }
  return services;
}

bool same(const model::Service& a, const model::Service& b) {
  return a.from_ns == b.from_ns && a.until_ns == b.until_ns && a.stage == b.stage &&
         a.fragment == b.fragment && a.packet == b.packet;
}

/// How many services agree before the first that differs; the run ends when discovery does, the
/// access point serves what is left.
std::size_t agreeing(const RunLog& run, const std::vector<model::Service>& services) {
  const std::size_t compared = std::min(run.services.size(), services.size());
  const auto end = run.services.begin() + static_cast<std::ptrdiff_t>(compared);
  const auto differing = std::mismatch(run.services.begin(), end, services.begin(), same);
  return static_cast<std::size_t>(differing.first - run.services.begin());
}

void expect_tie(const Scenario& simulated, std::size_t least_services) {
  ASSERT_EQ(why_not_served(simulated.wireless), std::nullopt);
  const RunLog run = run_and_log(simulated);
  EXPECT_GE(run.services.size(), least_services);
  const auto services = served_again(run, simulated, simulated.wireless);
  EXPECT_EQ(agreeing(run, services), run.services.size());
}

TEST(AccessPointTie, OnePairOfParticipants) {
  expect_tie(scenario("{hosts: 2, participants_per_host: 1, endpoints_per_participant: 2}", "paper",
                      emulated),
             40);
}

TEST(AccessPointTie, AStormWithFragmentsAndMulticast) {
  const Scenario storm = scenario(five_by_twenty, "paper", emulated);
  const RunLog run = run_and_log(storm);
  const auto fragments = [](const model::Service& s) { return s.fragment > 0; };
  const auto multicast = [](const model::Service& s) {
    return s.kind == model::PacketKind::spdp_multicast && s.stage == 1;
  };
  EXPECT_GT(std::count_if(run.services.begin(), run.services.end(), fragments), 100);
  EXPECT_GT(std::count_if(run.services.begin(), run.services.end(), multicast), 10);
  expect_tie(storm, 1'000);
}

TEST(AccessPointTie, FastDds) {
  expect_tie(scenario(five_by_twenty, "fastdds-2.6.11", emulated), 1'000);
}

/// The second participant starts when the first announcement has just gone up (462 bytes: 175596
/// ns), so that an uplink and a downlink are requested at one instant.
Scenario two_requests_at_once(const std::string& order) {
  return scenario(
      "{participants: [{host: 0, publications: 3, subscriptions: 2, start: 0ms}, "
      "{host: 1, publications: 9, subscriptions: 8, start: 175596ns}]}",
      "paper", "{base: emulated-ap, order: " + order + "}");
}

TEST(AccessPointTie, EveryOrder) {
  for (const std::string order : {"fifo", "fifo_uplink", "fifo_downlink"}) {
    SCOPED_TRACE(order);
    expect_tie(two_requests_at_once(order), 40);
  }
}

TEST(AccessPointTie, TheProfileOfThePaper) {
  expect_tie(
      scenario("{hosts: 2, participants_per_host: 2, endpoints_per_participant: 10}", "paper",
               "{base: wifi-80211n-paper, fragment_request: at_admission, source_queue_bytes: "
               "unlimited, mtu_payload_bytes: 520}"),
      200);
}

TEST(AccessPointTie, OverridesOfTheStages) {
  expect_tie(
      scenario("{hosts: 2, participants_per_host: 2, endpoints_per_participant: 10}", "paper",
               "{base: emulated-ap, stages: [{name: up, channel: air, multicast_as: "
               "multicast, overhead_multicast: 77us}, {name: down, channel: air, "
               "multicast_as: unicast, rate_unicast: 54Mbps}]}"),
      200);
}

TEST(AccessPointTie, Units) {
  for (const std::string more : {"arbitration: round_robin", "arbitration: oldest",
                                 "ap_queue: round_robin", "aggregation: {max_frames: 3}"}) {
    SCOPED_TRACE(more);
    expect_tie(
        scenario(five_by_twenty, "fastdds-2.6.11",
                 "{base: wifi-80211n-ampdu, sender: backlog, source_queue_bytes: unlimited, " +
                     more + "}"),
        1'000);
  }
}

TEST(AccessPointTie, Flows) {
  const Scenario simulated =
      scenario(five_by_twenty, "fastdds-2.6.11",
               "{base: wifi-80211n-ampdu, sender: backlog, source_queue_bytes: unlimited, "
               "queueing: flows}");
  expect_tie(simulated, 1'000);
  const RunLog run = run_and_log(simulated);
  model::WirelessProfile fifo = simulated.wireless;
  fifo.queueing = model::Queueing::fifo;
  EXPECT_LT(agreeing(run, served_again(run, simulated, fifo)), run.services.size());
}

TEST(AccessPointTie, QueuesThatDrop) {
  for (const std::string queue :
       {"queue: {discipline: tail_drop, max_frames: 100}", "queue: {discipline: codel}",
        "queueing: flows, queue: {discipline: fq_codel, max_frames: 300, of: access_points}"}) {
    SCOPED_TRACE(queue);
    const Scenario simulated =
        scenario(five_by_twenty, "fastdds-2.6.11",
                 "{base: wifi-80211n-ampdu, sender: backlog, source_queue_bytes: unlimited, "
                 "aggregation: {max_frames: 2}, " +
                     queue + "}");
    expect_tie(simulated, 1'000);
    const RunLog run = run_and_log(simulated);
    model::WirelessProfile unlimited = simulated.wireless;
    unlimited.queue.reset();
    EXPECT_LT(agreeing(run, served_again(run, simulated, unlimited)), run.services.size());
  }
}

TEST(AccessPointTie, OneNanosecondOrAnotherOrderIsSeen) {
  const Scenario simulated = two_requests_at_once("fifo_uplink");
  const RunLog run = run_and_log(simulated);
  model::WirelessProfile slower = simulated.wireless;
  slower.overhead_multicast += Nanoseconds{1};
  EXPECT_LT(agreeing(run, served_again(run, simulated, slower)), run.services.size());
  for (const auto order : {model::ServiceOrder::fifo_downlink, model::ServiceOrder::fifo}) {
    model::WirelessProfile other = simulated.wireless;
    other.order = order;
    EXPECT_EQ(agreeing(run, served_again(run, simulated, other)), 1U);
  }
}

}  // namespace simulator_tie_test
}  // namespace stormproof::live
