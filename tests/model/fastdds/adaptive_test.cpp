// The response-aware HEARTBEAT policy with Fast DDS's writer: whom a cycle contacts, and what
// counts as a response.
#include <gtest/gtest.h>

#include "tests/model/fastdds/fastdds_run.hpp"

namespace stormproof::model::fastdds {
namespace adaptive_test {

using Kind = PacketKind;
constexpr std::uint32_t pub_writer_of_0 = 0;

Scenario adaptive(Scenario scenario, std::int64_t period_ns, std::int64_t limit_ns) {
  scenario.dds.sedp.heartbeat_policy = HeartbeatPolicy::adaptive;
  scenario.dds.sedp.heartbeat_period = Nanoseconds{period_ns};
  scenario.time_limit = Nanoseconds{limit_ns};
  return scenario;
}

Times times_of_moves(const FastddsLog& log, const std::string& row) {
  Times times;
  for (const Move& move : log.moves_of("HeartbeatTimer 0: " + row)) times.push_back(move.time_ns);
  return times;
}

TEST(FastddsAdaptive, ACycleThatEverybodyAnswersEndsEarlyAndTheWriterRests) {
  const FastddsLog log = run(adaptive(one_writer(0), sec, 3 * sec));
  // The DATA arrive at 4.11 ms, but nothing is acknowledged before a HEARTBEAT asks.
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), (Times{ms, sec + ms}));
  EXPECT_EQ(times_of_moves(log, "Awaiting + ResponseReceived -> Idle"),
            Times{sec + 3 * ms + 10 * us});
  EXPECT_TRUE(log.timers(EventKind::heartbeat_expiry, pub_writer_of_0).empty());
  EXPECT_EQ(log.timers(EventKind::cycle_start, pub_writer_of_0).size(), 1U);
}

TEST(FastddsAdaptive, WithoutAReaderBehindACycleSendsNothing) {
  // pub0 at 100 ms; first cycle 110 ms, answered. The end of suppression, 10 us after a push, finds
  // the writer active; that of 350 ms finds it inactive and makes it active with nobody behind.
  Scenario scenario = adaptive(one_writer(100 * ms), 10 * ms, 290 * ms);
  scenario.dds.sedp.nack_suppression_duration = Nanoseconds{150 * ms};
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), (Times{ms, 110 * ms}));
  EXPECT_EQ(times_of_moves(log, "Idle + ArmRequested -> Pacing"), (Times{100 * ms, 250 * ms}));
  EXPECT_EQ(times_of_moves(log, "Pacing + CycleStarted -> Idle"), Times{260 * ms});
}

TEST(FastddsAdaptive, ACycleContactsOnlyReadersThatAreBehindWith68BytesEach) {
  Scenario scenario = adaptive(one_writer(0, 2), sec, 10 * sec);
  const std::vector<Emission> all = run(scenario).of(Kind::heartbeat, 0, 2);
  ASSERT_EQ(all.size(), 2U);
  lose(scenario, all[1].number, all[1].number + 1);  // of the first cycle, to 2
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 1), (Times{ms, sec + ms}));
  const std::vector<Emission> to_2 = log.of(Kind::heartbeat, 0, 2);
  // One of two has answered: the period is doubled, and 2 is asked again at the end of the cycle.
  EXPECT_EQ(log.times_of(Kind::heartbeat, 0, 2), (Times{ms, sec + ms, 2 * sec + ms}));
  for (const Emission& heartbeat : to_2) EXPECT_EQ(heartbeat.bytes, 68);
  // Publications 2 + 3, subscriptions 2 + 2, and the openings of 1 and 2.
  EXPECT_EQ(log.result.counts.heartbeat, 5U + 4U + 4U);
}

TEST(FastddsAdaptive, AReaderIsBehindUntilItAcknowledgesWhatIsRequestedToo) {
  // pub0 is acknowledged. pub1, pushed at 300 ms, is lost and requested at 332.01 ms, but the nack
  // response takes long. At the end of the cycle that began at 330 ms 1 is asked again.
  Scenario scenario = adaptive(one_writer(100 * ms), 30 * ms, 400 * ms);
  scenario.dds.sedp.nack_response_delay = Nanoseconds{sec};
  const std::uint64_t lost = run(scenario).number_of_data(0, 1, 1);
  lose(scenario, lost, lost + 1);
  EXPECT_EQ(run(scenario).times_of(Kind::heartbeat, 0, 1),
            (Times{ms, 130 * ms, 330 * ms, 360 * ms}));
  // For the periodic policy a requested descriptor is no reason.
  scenario.dds.sedp.heartbeat_policy = HeartbeatPolicy::periodic;
  EXPECT_EQ(run(scenario).times_of(Kind::heartbeat, 0, 1), (Times{ms, 130 * ms, 330 * ms}));
}

/// pub0 is pushed at 20 ms, and a cycle starts at 31.5 ms. The HEARTBEAT of the opening, which
/// announced nothing, is answered at 32 ms.
FastddsLog old_heartbeat_answered_in_the_cycle(bool lose_pub0) {
  Scenario scenario = adaptive(one_writer(20 * ms), 11'500 * us, 42 * ms);
  scenario.dds.sedp.heartbeat_response_delay = Nanoseconds{30 * ms};
  const std::uint64_t pub0 = run(scenario).number_of_data(0, 1, 0);
  if (lose_pub0) lose(scenario, pub0, pub0 + 1);
  return run(scenario);
}

TEST(FastddsAdaptive, AResponseMustCoverWhatExistedAtTheStartOfTheCycle) {
  const FastddsLog with = old_heartbeat_answered_in_the_cycle(false);
  EXPECT_EQ(with.of(Kind::acknack, 1, 0).at(0).detail, 1U);
  EXPECT_EQ(times_of_moves(with, "Pacing + CycleStarted -> Awaiting"), Times{31'500 * us});
  EXPECT_EQ(times_of_moves(with, "Awaiting + ResponseReceived -> Idle"), Times{33 * ms});

  const FastddsLog without = old_heartbeat_answered_in_the_cycle(true);
  EXPECT_EQ(without.of(Kind::acknack, 1, 0).at(0).detail, 0U);
  EXPECT_TRUE(without.of(Kind::acknack, 1, 0).at(0).descriptors.empty());
  EXPECT_EQ(times_of_moves(without, "Pacing + CycleStarted -> Awaiting"), Times{31'500 * us});
  for (const Move& move : without.moves) {
    EXPECT_EQ(move.what.find("ResponseReceived"), std::string::npos) << move.what;
  }
}

TEST(FastddsAdaptive, ARequestIsNoResponse) {
  Scenario scenario = adaptive(one_writer(0), 1'500 * us, 4 * ms);
  scenario.dds.sedp.adaptive.min_period = Nanoseconds{100 * us};
  const FastddsLog log = run(scenario);
  // The cycle of 2.5 ms waits; the ACKNACK that arrives at 3.01 ms asks for all nine.
  EXPECT_EQ(times_of_moves(log, "Pacing + CycleStarted -> Awaiting"), Times{2'500 * us});
  EXPECT_EQ(log.of(Kind::acknack, 1, 0).at(0).descriptors.size(), 9U);
  for (const Move& move : log.moves) {
    EXPECT_EQ(move.what.find("ResponseReceived"), std::string::npos) << move.what;
  }
}

}  // namespace adaptive_test
}  // namespace stormproof::model::fastdds
