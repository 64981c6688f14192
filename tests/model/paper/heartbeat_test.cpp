// The periodic HEARTBEAT: who gets it, when it stops, and how additive timers multiply.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace heartbeat_test {

using Times = std::vector<std::int64_t>;
constexpr std::uint64_t all_others = 100'000;
constexpr std::uint32_t pub_writer_of_0 = 0;

Times dues(const RunLog& log) {
  Times list;
  for (const Scheduled& event : log.scheduled_of(EventKind::heartbeat_expiry, pub_writer_of_0)) {
    list.push_back(event.due_ns);
  }
  return list;
}

TEST(Heartbeat, GoesOnAtThePeriodWhileSomethingIsUnacknowledged) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}});
  scenario.time_limit = Nanoseconds{2'500 * ms};
  lose(scenario, 1, all_others);
  EXPECT_EQ(run_and_log(scenario).times_of(PacketKind::heartbeat, 0, 1),
            (Times{ms, sec + ms, 2 * sec + ms}));
}

TEST(Heartbeat, TheTimerDiesWhenEverythingIsAcknowledged) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}, {1, 0, 9 * sec}});
  scenario.time_limit = Nanoseconds{8 * sec};
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1), Times{ms});
  EXPECT_EQ(dues(log), Times{sec + ms});
}

TEST(Heartbeat, ANewRelationArmsADeadTimerAgain) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}, {1, 0, 3 * sec}, {1, 0, 9 * sec}});
  scenario.dds.spdp.resend = SpdpResend::none;  // 2 recognises 0 with its announcement of 3.5 s
  scenario.time_limit = Nanoseconds{8 * sec};
  EXPECT_EQ(dues(run_and_log(scenario)), (Times{sec + ms, 4'501 * ms}));
}

TEST(Heartbeat, ANewRelationDoesNotArmAnArmedTimer) {
  for (const HeartbeatTimerKind kind : {HeartbeatTimerKind::single, HeartbeatTimerKind::additive}) {
    Scenario scenario = by_hand({{0, 1}, {1, 0}, {1, 0, 90 * ms}, {1, 0, 9 * sec}});
    scenario.dds.spdp.resend = SpdpResend::none;
    scenario.dds.sedp.heartbeat_timer = kind;
    scenario.time_limit = Nanoseconds{sec};
    const RunLog log = run_and_log(scenario);
    EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 2), Times{101 * ms});
    EXPECT_EQ(dues(log), Times{sec + ms});
  }
}

/// Readers 1 and 2 get everything at once, but what 2 acknowledges in the first 0.9 s is lost.
Times second_heartbeats(HeartbeatRecipients recipients, std::uint32_t reader) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}, {1, 0}, {0, 1, 9 * sec}});
  scenario.dds.sedp.heartbeat_recipients = recipients;
  scenario.time_limit = Nanoseconds{900 * ms};
  std::vector<std::uint64_t> lost;
  for (const Sent& acknack : run_and_log(scenario).of(PacketKind::acknack, 2, 0)) {
    lost.push_back(acknack.number);
  }
  EXPECT_EQ(lost.size(), 1U);
  scenario.wireless.lost_packets = lost;
  scenario.time_limit = Nanoseconds{1'500 * ms};
  Times times = run_and_log(scenario).times_of(PacketKind::heartbeat, 0, reader);
  EXPECT_EQ(times.at(0), ms);
  times.erase(times.begin());
  return times;
}

TEST(Heartbeat, GoesOnlyToReadersThatLackSomething) {
  EXPECT_EQ(second_heartbeats(HeartbeatRecipients::unacknowledged, 1), Times{});
  EXPECT_EQ(second_heartbeats(HeartbeatRecipients::unacknowledged, 2), Times{sec + ms});
}

TEST(Heartbeat, MayGoToAllMatchedReadersIfOneLacksSomething) {
  EXPECT_EQ(second_heartbeats(HeartbeatRecipients::matched, 1), Times{sec + ms});
  EXPECT_EQ(second_heartbeats(HeartbeatRecipients::matched, 2), Times{sec + ms});
}

/// The first DATA is lost and repaired; what 1 sends from one second on is lost, so HEARTBEATs
/// never stop.
RunLog after_one_repair(HeartbeatTimerKind kind) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}, {1, 0, 9 * sec}});
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.dds.sedp.heartbeat_timer = kind;
  scenario.time_limit = Nanoseconds{sec};
  lose(scenario, 2, 3);
  const std::uint64_t first_after = run_and_log(scenario).sent.size();
  lose(scenario, first_after, all_others);
  scenario.time_limit = Nanoseconds{2'500 * ms};
  return run_and_log(scenario);
}

TEST(Heartbeat, ASingleTimerIsNotArmedByTheEndOfASuppression) {
  const RunLog log = after_one_repair(HeartbeatTimerKind::single);
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1), (Times{ms, sec + ms, 2 * sec + ms}));
}

TEST(Heartbeat, AnAdditiveTimerIsAndThenFiresTwiceAPeriod) {
  const RunLog log = after_one_repair(HeartbeatTimerKind::additive);
  const std::int64_t end = 3 * ms + 120 * us;  // of the suppression
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1),
            (Times{ms, sec + ms, sec + end, 2 * sec + ms, 2 * sec + end}));
  EXPECT_EQ(dues(log),
            (Times{sec + ms, sec + end, 2 * sec + ms, 2 * sec + end, 3 * sec + ms, 3 * sec + end}));
}

TEST(Heartbeat, AStreamWithoutDescriptorsNeverNeedsAnother) {
  Scenario scenario = by_hand({{0, 1}, {1, 0}});
  scenario.time_limit = Nanoseconds{2'500 * ms};
  lose(scenario, 1, all_others);
  EXPECT_EQ(run_and_log(scenario).times_of(PacketKind::heartbeat, 0, 1, Stream::sub), Times{ms});
}

}  // namespace heartbeat_test
}  // namespace stormproof::model
