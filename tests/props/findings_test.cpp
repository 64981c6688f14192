// Properties that correct runs violate, each on a small scenario that shows why: the checks are not
// there to agree with the rules.
#include <gtest/gtest.h>

#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace findings_test {

const char* const lost_batch = "wireless.lost_packets=[2,3,4,5,6,7,8,9,10]";

TEST(Findings, ARepairBatchThatSpansPacketsIsNotSuppressedLongEnough) {
  const MonitoredRun run = run_monitored(
      shipped("smallest", {"dds.sedp.nack_suppression_duration=2ms", "dds.sedp.grouping=mtu",
                           lost_batch, "run_until=time_limit", "time_limit=3s"}));
  ASSERT_NE(run.violation("timer.suppression-honoured"), nullptr);
  EXPECT_EQ(run.violation("timer.suppression-honoured")->reason,
            "The suppression of descriptor 3 of participant 0's sub stream at participant 1 ends "
            "at 17.49194 ms, 1.723173 ms after its own repair left the source at 15.768767 ms; "
            "τ_S is 2 ms.");
  EXPECT_EQ(run.violated(), "timer.suppression-honoured storm.join-cost");
}

TEST(Findings, TheSameBatchInOnePacketIsSuppressedLongEnough) {
  const MonitoredRun run =
      run_monitored(shipped("smallest", {"dds.sedp.nack_suppression_duration=100us", lost_batch,
                                         "run_until=time_limit", "time_limit=3s"}));
  EXPECT_EQ(run.violated(), "storm.join-cost");
  EXPECT_EQ(run.remarks("timer.suppression-honoured"),
            "The shortest suppression of a descriptor was 100 µs; τ_S is 100 µs.\n");
}

TEST(Findings, AdditiveTimersMultiply) {
  const std::vector<std::string> overrides{lost_batch, "run_until=time_limit", "time_limit=3s"};
  EXPECT_EQ(run_monitored(shipped("smallest", overrides)).violated(), "storm.join-cost");
  auto additive = overrides;
  additive.emplace_back("dds.sedp.heartbeat_timer=additive");
  EXPECT_EQ(run_monitored(shipped("smallest", additive)).violated(),
            "timer.single-heartbeat storm.join-cost");
}

/// One suppression timer serves the whole relation, and it runs from the first serialization.
TEST(Findings, FastDdsSuppressesTooShort) {
  const MonitoredRun run = run_monitored(shipped("wifi-5x20-fastdds"));
  ASSERT_NE(run.violation("timer.suppression-honoured"), nullptr);
  EXPECT_EQ(run.violation("timer.suppression-honoured")->event, 1192U);
}

TEST(Findings, AStormRepairsWhatIsUnderWay) {
  const MonitoredRun run = run_monitored(shipped("wifi-5x20"));
  EXPECT_EQ(run.violated(),
            "storm.join-cost storm.single-copy storm.free-threshold storm.cannot-start");
  EXPECT_EQ(run.violation("storm.free-threshold")->event, 16489U);
}

/// Without any delay a decision and what it causes happen at the same instant.
TEST(Findings, ALinkWithoutDelayBreaksTheOrderOfAnInstant) {
  const MonitoredRun run =
      run_monitored(shipped("smallest", {"wireless={kind: constant_delay, one_way: 0ns}"}));
  ASSERT_NE(run.violation("order.reception-first"), nullptr);
  EXPECT_EQ(run.violation("order.reception-first")->event, 1U);
}

/// The HEARTBEAT of an opening is lost, all DATA arrives: initial ACKNACKs acknowledge it, so the
/// writer falls silent, and the reader goes on asking, ever more rarely.
TEST(Findings, InitialAckNacksNeverEndAfterALostHeartbeat) {
  const MonitoredRun run = run_monitored(
      shipped("smallest", {"wireless={kind: constant_delay, one_way: 1ms, lost_packets: [5]}",
                           "dds.sedp.piggyback=off", "run_until=time_limit", "time_limit=10s"}));
  ASSERT_TRUE(run.result.completed());
  EXPECT_EQ(run.violated(), "live.quiescence storm.join-cost");
}

}  // namespace findings_test
}  // namespace stormproof::props
