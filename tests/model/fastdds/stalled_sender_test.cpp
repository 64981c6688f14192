// What `sender: stalls` holds back, and when it happens instead.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace stalled_sender_test {

/// Each access takes 100 ms, and a source queue has room for one packet: participant 1, which
/// recognises 0 at 200 ms and answers, stalls when its endpoints are created and its initial
/// ACKNACKs are due.
Scenario slow_channel() {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 1, 0);
  Participant& late = scenario.deployment.participants[1];
  late.start = Nanoseconds{150 * ms};
  late.endpoints_done = Nanoseconds{260 * ms};
  scenario.dds.implementation = ImplementationKind::fastdds;
  scenario.dds.spdp.startup_announcements = 0;
  WirelessProfile& w = scenario.wireless;
  w.overhead_unicast = w.overhead_multicast = Nanoseconds{100 * ms};
  w.rate_unicast = w.rate_multicast = BitsPerSecond{1'000'000'000'000'000};
  w.source_queue_bytes = Bytes{1};
  w.order = ServiceOrder::fifo;
  w.fragment_request = FragmentRequest::at_admission;
  w.sender = Sender::stalls;
  scenario.time_limit = Nanoseconds{60 * sec};
  return scenario;
}

std::vector<Scheduled> held(const RunLog& log, EventKind kind) {
  std::vector<Scheduled> list;
  for (const Scheduled& s : log.rescheduled) {
    if (s.kind == kind) list.push_back(s);
  }
  return list;
}

TEST(StalledSender, CreationsWaitAndHappenInTheirOrder) {
  const RunLog log = run_and_log(slow_channel());
  const std::vector<Scheduled> creations = held(log, EventKind::endpoint_creation);
  ASSERT_GT(creations.size(), 1U);
  EXPECT_EQ(creations[0].subject, 1U);
  EXPECT_GT(creations[0].due_ns, 260 * ms);
  // All that were due meanwhile happen at one instant, before the ACKNACKs that were due after
  // them.
  EXPECT_EQ(creations[1].due_ns, creations[0].due_ns);
  const auto first = [&](EventKind kind) {
    return std::ranges::find(log.rescheduled, kind, &Scheduled::kind) - log.rescheduled.begin();
  };
  EXPECT_LT(first(EventKind::endpoint_creation), first(EventKind::initial_acknack_due));
}

TEST(StalledSender, AnInitialAckNackWaits) {
  const Scenario scenario = slow_channel();
  const RunLog log = run_and_log(scenario);
  const std::vector<Scheduled> due = log.scheduled_of(EventKind::initial_acknack_due, 0);
  const std::vector<Scheduled> later = held(log, EventKind::initial_acknack_due);
  ASSERT_FALSE(due.empty());
  ASSERT_FALSE(later.empty());
  EXPECT_EQ(due[0].due_ns, due[0].at_ns + scenario.dds.sedp.initial_acknack_delay.count());
  EXPECT_GT(later[0].due_ns, due[0].due_ns);
  for (const Sent& sent : log.sent) {
    if (sent.kind == PacketKind::acknack && sent.source == 1) {
      EXPECT_GE(sent.time_ns, later[0].due_ns);
    }
  }
}

TEST(StalledSender, ReceptionsGoOnAndNothingIsHeldWithRoomInTheQueue) {
  Scenario scenario = slow_channel();
  scenario.wireless.source_queue_bytes = WirelessProfile::unlimited;
  EXPECT_TRUE(held(run_and_log(scenario), EventKind::endpoint_creation).empty());
  // An ACKNACK that arrives while its writer stalls is answered: the run completes.
  EXPECT_TRUE(run_and_log(slow_channel()).result.completed());
}

TEST(CountAtAdmission, WhatIsStillInTheBacklogDoesNotCount) {
  Scenario scenario = slow_channel();
  scenario.wireless.sender = Sender::backlog;
  const RunLog generated = run_and_log(scenario);
  scenario.wireless.count_at = CountAt::admission;
  const RunLog admitted = run_and_log(scenario);
  EXPECT_EQ(admitted.result.discovery_time, generated.result.discovery_time);
  EXPECT_LT(admitted.result.counts.total(), generated.result.counts.total());
  scenario.wireless.source_queue_bytes = WirelessProfile::unlimited;
  const RunLog all_admitted = run_and_log(scenario);
  scenario.wireless.count_at = CountAt::generation;
  const RunLog all_generated = run_and_log(scenario);
  EXPECT_EQ(all_admitted.result.counts, all_generated.result.counts);
  EXPECT_EQ(all_admitted.result.user_control, all_generated.result.user_control);
}

}  // namespace stalled_sender_test
}  // namespace stormproof::model
