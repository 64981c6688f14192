// Relations of which only HEARTBEATs and ACKNACKs are modelled: when each side opens, who answers
// what and when, and how they are counted.
#include <gtest/gtest.h>

#include "tests/model/fastdds/fastdds_run.hpp"

namespace stormproof::model::fastdds {
namespace control_test {

using Kind = PacketKind;
constexpr std::uint64_t all_others = 100'000;
// Control-only relations of the pair (0, 1), the first one, when it has no user topics.
constexpr std::uint32_t liveliness = 0;
constexpr std::uint32_t ros_discovery_info = 1;
constexpr std::uint32_t parameter_events = 2;

/// Packets of one control-only relation.
std::vector<Emission> of(const FastddsLog& log, Kind kind, std::uint32_t relation) {
  std::vector<Emission> found;
  for (const Emission& packet : log.sent) {
    if (packet.kind == kind && packet.detail == relation) found.push_back(packet);
  }
  return found;
}

Times times_of(const FastddsLog& log, Kind kind, std::uint32_t relation) {
  Times times;
  for (const Emission& packet : of(log, kind, relation)) times.push_back(packet.time_ns);
  return times;
}

Times opened(const FastddsLog& log, const std::string& side, std::uint32_t relation) {
  Times times;
  const std::string what = side + " " + std::to_string(relation) + ": Closed + Opened -> Open";
  for (const Move& move : log.moves_of(what)) times.push_back(move.time_ns);
  return times;
}

/// 0 and 1, both with all their endpoints from the start, and 2, which comes much later, so that
/// the run goes on when 0 and 1 have discovered each other.
Scenario two_and_a_late_one() {
  Scenario scenario =
      fastdds_by_hand({{.host = 0}, {.host = 1}, {.host = 1, .start_ns = 50 * sec}});
  scenario.time_limit = Nanoseconds{2 * sec};
  return scenario;
}

TEST(FastddsControl, LivelinessOpensWithRecognitionAndIsAnsweredAfter5Ms) {
  const FastddsLog log = run(two_and_a_late_one());
  EXPECT_EQ(opened(log, "ControlReader", liveliness), Times{ms});
  EXPECT_EQ(opened(log, "ControlWriter", liveliness), Times{ms});
  EXPECT_EQ(times_of(log, Kind::user_heartbeat, liveliness), Times{ms});
  EXPECT_EQ(times_of(log, Kind::user_acknack, liveliness), Times{7 * ms});
  EXPECT_EQ(of(log, Kind::user_heartbeat, liveliness)[0].bytes, 68);
  EXPECT_EQ(of(log, Kind::user_acknack, liveliness)[0].bytes, 64);
  EXPECT_EQ(of(log, Kind::user_acknack, liveliness)[0].source, 1U);
}

TEST(FastddsControl, TopicsOpenWhenBothEndpointsAreKnown) {
  const FastddsLog log = run(two_and_a_late_one());
  // The DATA arrive at 4.11 ms on both sides; then HEARTBEAT, 1 ms, 5 ms.
  for (const std::uint32_t relation : {ros_discovery_info, parameter_events}) {
    EXPECT_EQ(opened(log, "ControlReader", relation), Times{4'110 * us});
    EXPECT_EQ(opened(log, "ControlWriter", relation), Times{4'110 * us});
    EXPECT_EQ(times_of(log, Kind::user_heartbeat, relation), Times{4'110 * us});
    EXPECT_EQ(times_of(log, Kind::user_acknack, relation), Times{10'110 * us});
  }
}

TEST(FastddsControl, IsCountedAtEmissionAndInNoOtherClass) {
  Scenario scenario = two_and_a_late_one();
  const FastddsLog log = run(scenario);
  EXPECT_EQ(log.result.user_control, 2U * 3U * 2U);  // three relations in each direction
  EXPECT_EQ(log.result.counts.heartbeat, 4U + 4U);   // opening, and the periodic one of 1.001 s
  EXPECT_EQ(log.result.counts.acknack, 4U + 4U);
  scenario.time_limit = Nanoseconds{ms};
  EXPECT_EQ(run(scenario).result.user_control, 2U);  // not yet received
}

TEST(FastddsControl, ATopicWithOneSideOnlyHasOnlyThatSidesRelations) {
  Scenario scenario = two_and_a_late_one();
  scenario.deployment.participants[0].publications = 2;
  scenario.deployment.participants[1].subscriptions = 1;
  const FastddsLog log = run(scenario);
  std::size_t writers = 0;
  std::size_t readers = 0;
  for (const Move& move : log.moves) {
    const bool opens = move.what.ends_with(": Closed + Opened -> Open");
    if (opens && move.what.starts_with("ControlWriter")) ++writers;
    if (opens && move.what.starts_with("ControlReader")) ++readers;
  }
  // Three in each direction, and user topic 0 from 0 to 1; user topic 1 has no subscription.
  EXPECT_EQ(writers, 7U);
  EXPECT_EQ(readers, 7U);
  EXPECT_EQ(times_of(log, Kind::user_heartbeat, 3), Times{4'110 * us});
  EXPECT_EQ(of(log, Kind::user_heartbeat, 3)[0].source, 0U);
}

TEST(FastddsControl, OneReplyIsPendingAtATime) {
  Scenario scenario = two_and_a_late_one();
  scenario.dds.sedp.initial_acknack_delay = Nanoseconds{500 * us};
  scenario.time_limit = Nanoseconds{20 * ms};
  const FastddsLog log = run(scenario);
  // 1 asks at 1.5 ms, before the HEARTBEAT of 1 ms arrives at 2 ms; the answer arrives at 3.5 ms.
  EXPECT_EQ(times_of(log, Kind::user_heartbeat, liveliness), (Times{ms, 2'500 * us}));
  EXPECT_EQ(times_of(log, Kind::user_acknack, liveliness), (Times{1'500 * us, 7 * ms}));
  EXPECT_TRUE(of(log, Kind::user_acknack, liveliness)[0].initial);
  EXPECT_FALSE(of(log, Kind::user_acknack, liveliness)[1].initial);
}

TEST(FastddsControl, InitialAckNacksDoubleTheirDelay) {
  Scenario scenario = two_and_a_late_one();
  scenario.time_limit = Nanoseconds{1'100 * ms};
  lose(scenario, 1, all_others);  // 1 recognises 0, and nothing else ever arrives
  const FastddsLog log = run(scenario);
  EXPECT_EQ(times_of(log, Kind::user_acknack, liveliness),
            (Times{71 * ms, 211 * ms, 491 * ms, 1'051 * ms}));
  EXPECT_TRUE(opened(log, "ControlWriter", liveliness).empty());
}

TEST(FastddsControl, InitialAckNacksKeepAConstantInterval) {
  Scenario scenario = two_and_a_late_one();
  scenario.dds.sedp.initial_acknack_interval = InitialAckNackInterval::constant;
  scenario.time_limit = Nanoseconds{300 * ms};
  lose(scenario, 1, all_others);  // 1 recognises 0, and nothing else ever arrives
  EXPECT_EQ(times_of(run(scenario), Kind::user_acknack, liveliness),
            (Times{71 * ms, 141 * ms, 211 * ms, 281 * ms}));
}

TEST(FastddsControl, AClosedWriterSideIgnoresAnInitialAckNackAndAnOpenOneAnswersIt) {
  Scenario scenario = two_and_a_late_one();
  lose(scenario, 1, 2);  // 0 recognises 1 at 101 ms only
  const FastddsLog log = run(scenario);
  EXPECT_EQ(times_of(log, Kind::user_acknack, liveliness), (Times{71 * ms, 107 * ms}));
  EXPECT_EQ(times_of(log, Kind::user_heartbeat, liveliness), Times{101 * ms});
}

/// The first DATA packet of 0's publications is lost; 1's subscriptions reach 0 at 4.11 ms.
FastddsLog first_publications_lost() {
  Scenario scenario = two_and_a_late_one();
  const std::uint64_t lost = run(scenario).number_of_data(0, 1, 0);
  lose(scenario, lost, lost + 1);
  return run(scenario);
}

TEST(FastddsControl, AHeartbeatAtAClosedReaderSideIsDropped) {
  const FastddsLog log = first_publications_lost();
  // HEARTBEAT 1.001 s, ACKNACK 1.00201 s, repair 1.00311 s, which arrives 1 ms later.
  const std::int64_t repaired = sec + 4'110 * us;
  EXPECT_EQ(opened(log, "ControlWriter", ros_discovery_info), Times{4'110 * us});
  EXPECT_EQ(opened(log, "ControlReader", ros_discovery_info), Times{repaired});
  // The reader has seen no HEARTBEAT, asks after 70 ms, and is answered.
  EXPECT_EQ(times_of(log, Kind::user_heartbeat, ros_discovery_info),
            (Times{4'110 * us, repaired + 71 * ms}));
  EXPECT_EQ(times_of(log, Kind::user_acknack, ros_discovery_info),
            (Times{repaired + 70 * ms, repaired + 77 * ms}));
}

TEST(FastddsControl, DescriptorsAreNotifiedInSequenceOnly) {
  // 0 creates pub0, sub0, pub1, …, pub8, sub7 every 10 ms; 1 has everything before.
  Scenario scenario = fastdds_by_hand(
      {{.host = 0, .step_ns = 10 * ms}, {.host = 1}, {.host = 1, .start_ns = 50 * sec}});
  scenario.time_limit = Nanoseconds{2 * sec};
  const FastddsLog whole = run(scenario);
  EXPECT_EQ(opened(whole, "ControlReader", ros_discovery_info), Times{11 * ms});
  EXPECT_EQ(opened(whole, "ControlReader", parameter_events), Times{161 * ms});
  const std::uint64_t lost = whole.number_of_data(0, 1, 0);
  lose(scenario, lost, lost + 1);
  const FastddsLog log = run(scenario);
  // pub8 arrives at 161 ms as before, but is notified after the repair of pub0.
  const Times repaired{sec + 10 * ms + 3'110 * us};
  EXPECT_EQ(log.times_of(Kind::data, 0, 1).back() + ms, repaired[0]);
  EXPECT_EQ(opened(log, "ControlReader", ros_discovery_info), repaired);
  EXPECT_EQ(opened(log, "ControlReader", parameter_events), repaired);
}

TEST(FastddsControl, TheWriterSideOpensWithItsOwnPublicationIfThatComesLast) {
  Scenario scenario = fastdds_by_hand(
      {{.host = 0, .step_ns = 10 * ms}, {.host = 1}, {.host = 1, .start_ns = 50 * sec}});
  scenario.time_limit = Nanoseconds{300 * ms};
  const FastddsLog log = run(scenario);
  // 0 knows 1's subscriptions since 4.11 ms, creates pub0 at 10 ms and pub8 at 160 ms.
  EXPECT_EQ(opened(log, "ControlWriter", ros_discovery_info), Times{10 * ms});
  EXPECT_EQ(opened(log, "ControlWriter", parameter_events), Times{160 * ms});
}

}  // namespace control_test
}  // namespace stormproof::model::fastdds
