// Packets with delays of their own: the schedule that is written down is the one that happens.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace packet_delays_test {

/// Two participants, one publication at the first; every packet takes 1 ms.
Scenario one_publication() { return by_hand({{0, 1}, {1, 0}}); }

/// The scenario, observed for 50 ms whatever happens.
Scenario observed(Scenario scenario) {
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{50 * ms};
  return scenario;
}

std::int64_t arrival(const RunLog& log, std::uint64_t packet) {
  for (const Arrived& arrived : log.arrived) {
    if (arrived.packet == packet) return arrived.time_ns;
  }
  return -1;
}

TEST(PacketDelays, APacketArrivesAfterItsOwnDelay) {
  Scenario scenario = observed(one_publication());
  const RunLog usual = run_and_log(scenario);
  // Packet 0 is participant 0's announcement; DATA follows from its reception.
  EXPECT_EQ(usual.sent[0].source, 0U);
  EXPECT_EQ(arrival(usual, 0), 1 * ms);
  EXPECT_EQ(usual.result.discovery_time, Nanoseconds{2 * ms});

  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{5 * ms}}};
  const RunLog late = run_and_log(scenario);
  EXPECT_EQ(arrival(late, 0), 5 * ms);
  EXPECT_EQ(arrival(late, 1), 1 * ms);
  // Participant 0 has recognised 1 by then and announces itself again: from that 1 learns of it.
  EXPECT_EQ(late.result.discovery_time, Nanoseconds{3 * ms});
}

TEST(PacketDelays, CopiesOfOneRecordHaveTheirOwn) {
  // Three hosts: with `resend: all_known` a participant sends copies of its announcement.
  const Scenario scenario = observed(by_hand({{0, 1}, {1, 1}, {2, 1}}));
  const RunLog usual = run_and_log(scenario);
  for (const std::uint64_t packet : {4U, 5U, 6U, 7U, 8U}) {
    Scenario changed = scenario;
    changed.wireless.packet_delays = {{packet, Nanoseconds{0}, Nanoseconds{1 * ms + 7}}};
    EXPECT_EQ(arrival(run_and_log(changed), packet), usual.sent[packet].time_ns + ms + 7);
  }
}

TEST(PacketDelays, ARepairLeavesItsSourceWhenItIsToldTo) {
  // The DATA of publication 0 is lost; its HEARTBEAT leads to an ACKNACK and a repair.
  Scenario scenario = one_publication();
  const auto number_of = [&](PacketKind kind, bool repair) {
    for (const Sent& packet : run_and_log(scenario).sent) {
      if (packet.kind == kind && packet.from_repair == repair) return packet.number;
    }
    return std::uint64_t{0};
  };
  scenario.wireless.lost_packets = {number_of(PacketKind::data, false)};
  const std::uint64_t repair = number_of(PacketKind::data, true);
  ASSERT_GT(repair, 0U);
  const auto suppression_ends = [&](std::int64_t leaves_after, std::int64_t one_way) {
    scenario.wireless.packet_delays = {{repair, Nanoseconds{leaves_after}, Nanoseconds{one_way}}};
    const RunLog log = run_and_log(scenario);
    const auto scheduled = log.scheduled_of(EventKind::suppression_end, 0);
    EXPECT_EQ(scheduled.size(), 1U);
    EXPECT_EQ(arrival(log, repair), log.sent[repair].time_ns + one_way);
    return scheduled.empty() ? -1 : scheduled[0].at_ns - log.sent[repair].time_ns;
  };
  EXPECT_EQ(suppression_ends(0, 2 * ms), 0);
  EXPECT_EQ(suppression_ends(3, 2 * ms), 3);
  EXPECT_EQ(suppression_ends(2 * ms - 1, 2 * ms), 2 * ms - 1);
}

TEST(PacketDelays, ReceptionComesFirstWhenAPacketLeavesAndArrivesAtOnce) {
  Scenario scenario = observed(one_publication());
  scenario.wireless.packet_delays = {{0, Nanoseconds{3 * ms}, Nanoseconds{3 * ms}}};
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(arrival(log, 0), 3 * ms);
  const auto left = log.scheduled_of(EventKind::source_completion, 0);
  ASSERT_FALSE(left.empty());
  EXPECT_EQ(left[0].due_ns, 3 * ms);
}

TEST(PacketDelays, HoldWithFastddsToo) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 2);
  scenario.dds.implementation = ImplementationKind::fastdds;
  scenario.wireless.kind = ServiceKind::constant_delay;
  scenario.wireless.one_way = Nanoseconds{ms};
  const auto first_reception = [&] {
    const RunLog log = run_and_log(scenario);
    for (const Scheduled& event : log.scheduled) {
      if (event.kind == EventKind::reception) return event.due_ns - event.at_ns;
    }
    return std::int64_t{-1};
  };
  EXPECT_EQ(first_reception(), ms);
  scenario.wireless.packet_delays = {{0, Nanoseconds{0}, Nanoseconds{42}}};
  EXPECT_EQ(first_reception(), 42);
}

}  // namespace packet_delays_test
}  // namespace stormproof::model
