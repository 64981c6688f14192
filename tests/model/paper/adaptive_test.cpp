// The response-aware HEARTBEAT policy in runs that can be followed by hand: a cycle that nobody
// answers, one that is answered after its end, and one that ends early.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace adaptive_test {

using Times = std::vector<std::int64_t>;
constexpr std::uint64_t all_others = 100'000;
constexpr std::uint32_t pub_writer_of_0 = 0;

Scenario adaptive(const std::vector<Node>& nodes) {
  Scenario scenario = by_hand(nodes);
  scenario.dds.sedp.heartbeat_policy = HeartbeatPolicy::adaptive;
  return scenario;
}

Times cycle_starts(const RunLog& log) {
  Times list;
  for (const Scheduled& event : log.scheduled_of(EventKind::cycle_start, pub_writer_of_0)) {
    list.push_back(event.due_ns);
  }
  return list;
}

TEST(Adaptive, SilentReadersAreAskedInBatchesSpreadOverTheRestOfThePeriod) {
  Scenario scenario = adaptive({{0, 1}, {1, 0}, {1, 0}, {1, 0}});
  scenario.time_limit = Nanoseconds{7'500 * ms};
  lose(scenario, 1, all_others);  // three readers that never answer
  const RunLog log = run_and_log(scenario);
  // Opening, first cycle (T = 1 s), a batch in the 2 s by which T grows to its upper bound, second
  // cycle, and at its end (T cannot grow) a batch at once and the third cycle one nanosecond later.
  const std::int64_t c = sec + ms;
  for (std::int64_t k = 0; k < 3; ++k) {
    const Times expected{ms,          c,           c + sec + 2 * sec * k / 3,
                         c + 3 * sec, c + 6 * sec, c + 6 * sec + 1};
    EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, static_cast<std::uint32_t>(k + 1)), expected)
        << k;
  }
  EXPECT_EQ(cycle_starts(log), (Times{c, c + 3 * sec, c + 6 * sec + 1}));
}

TEST(Adaptive, ALateResponseOfEverybodyEndsTheCycleThatWasStretched) {
  Scenario scenario = adaptive({{0, 1}, {1, 0}, {1, 0, 20 * sec}});
  scenario.time_limit = Nanoseconds{1'500 * ms};
  lose(scenario, 1, all_others);
  const Times first = run_and_log(scenario).times_of(PacketKind::heartbeat, 0, 1);
  ASSERT_EQ(first, (Times{ms, sec + ms}));
  const std::uint64_t second = run_and_log(scenario).of(PacketKind::heartbeat, 0, 1).at(1).number;
  scenario.wireless.lost_packets.clear();
  lose(scenario, 1, second);  // from the first cycle's HEARTBEAT on, everything arrives
  scenario.time_limit = Nanoseconds{19 * sec};
  const RunLog log = run_and_log(scenario);
  // The first answer asks for the descriptor, so it is no response; the batch at the end of the
  // cycle is answered by a clean ACKNACK, and with everything acknowledged the writer becomes
  // inactive.
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1), (Times{ms, sec + ms, 2 * sec + ms}));
  EXPECT_EQ(cycle_starts(log), (Times{sec + ms, 4 * sec + ms}));  // the second one is void
}

TEST(Adaptive, TheLastResponseEndsTheCycleEarlyAndShortensThePeriod) {
  // 1 has everything, but its first ACKNACK is lost; 2 starts so that its relation opens during the
  // cycle.
  Scenario scenario = adaptive({{0, 1}, {1, 0}, {1, 0, sec}, {1, 0, 30 * sec}});
  scenario.time_limit = Nanoseconds{900 * ms};
  const Sent acknack = run_and_log(scenario).of(PacketKind::acknack, 1, 0).at(0);
  lose(scenario, acknack.number, acknack.number + 1);
  scenario.time_limit = Nanoseconds{3 * sec};
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1), (Times{ms, sec + ms}));
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 2), Times{sec + 2 * ms});
  // The response comes 2.01 ms after the start of the cycle: T becomes its lower bound of 100 ms.
  // At the next cycle start 2 has acknowledged, too, and nobody is left.
  EXPECT_EQ(cycle_starts(log), (Times{sec + ms, sec + 101 * ms}));
}

TEST(Adaptive, AWriterWithNothingUnacknowledgedBecomesInactiveAndActiveAgain) {
  Scenario scenario = adaptive({{0, 1}, {1, 0}, {1, 0, 3 * sec}, {1, 0, 30 * sec}});
  scenario.dds.spdp.resend = SpdpResend::none;  // 2 recognises 0 with its announcement of 3.5 s
  scenario.time_limit = Nanoseconds{8 * sec};
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 0, 1), Times{ms});
  EXPECT_EQ(cycle_starts(log), (Times{sec + ms, 4'501 * ms}));
}

TEST(Adaptive, TheEndOfASuppressionSchedulesNothing) {
  Scenario scenario = adaptive({{0, 1}, {1, 0}, {1, 0, 9 * sec}});
  scenario.dds.spdp.resend = SpdpResend::none;
  scenario.time_limit = Nanoseconds{900 * ms};
  lose(scenario, 2, 3);
  const RunLog log = run_and_log(scenario);
  EXPECT_EQ(log.scheduled_of(EventKind::suppression_end, 0).size(), 1U);
  EXPECT_EQ(cycle_starts(log), Times{sec + ms});
  EXPECT_TRUE(log.scheduled_of(EventKind::heartbeat_expiry, pub_writer_of_0).empty());
}

}  // namespace adaptive_test
}  // namespace stormproof::model
