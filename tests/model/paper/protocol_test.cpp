// How a run ends: completion, the time limit, an interruption, and deployments in which streams or
// all participants have nothing to advertise.
#include <gtest/gtest.h>

#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace protocol_test {

TEST(RunEnd, TheTimeLimitIsInclusive) {
  Scenario scenario = by_hand({{0, 3}, {1, 2}});
  scenario.time_limit = Nanoseconds{2 * ms};
  const RunResult in_time = simulate(scenario);
  EXPECT_EQ(in_time.end, RunEnd::completed);
  EXPECT_EQ(in_time.discovery_time, Nanoseconds{2 * ms});
  EXPECT_TRUE(in_time.missing.empty());
}

TEST(RunEnd, OneNanosecondLessIsIncompleteAndSaysWhatIsMissing) {
  Scenario scenario = by_hand({{0, 3}, {1, 2}});
  scenario.time_limit = Nanoseconds{2 * ms - 1};
  const RunResult late = simulate(scenario);
  EXPECT_EQ(late.end, RunEnd::time_limit);
  EXPECT_FALSE(late.discovery_time.has_value());
  EXPECT_EQ(late.missing_count, 5U);
  ASSERT_EQ(late.missing.size(), 5U);
  EXPECT_EQ(late.missing[2].source, ParticipantId{0});
  EXPECT_EQ(late.missing[2].destination, ParticipantId{1});
  EXPECT_EQ(late.missing[2].descriptor, DescriptorId{2});
  EXPECT_EQ(late.missing[3].source, ParticipantId{1});
}

TEST(RunEnd, TheListOfMissingDescriptorsIsCutButTheirNumberIsNot) {
  Scenario scenario = by_hand({{0, 250}, {1, 2}});
  scenario.time_limit = Nanoseconds{ms};
  const RunResult result = simulate(scenario);
  EXPECT_EQ(result.missing_count, 252U);
  EXPECT_EQ(result.missing.size(), RunResult::missing_listed);
}

TEST(RunEnd, TheCallerMayInterrupt) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 5, 20);
  RunOptions options;
  std::uint64_t calls = 0;
  options.on_progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.events, RunOptions::progress_interval * ++calls);
    EXPECT_EQ(progress.required, 1'850U);
    EXPECT_LE(progress.missing, progress.required);
    return calls < 2;
  };
  const RunResult result = simulate(scenario, options);
  EXPECT_EQ(calls, 2U);
  EXPECT_EQ(result.end, RunEnd::interrupted);
  EXPECT_EQ(result.events, 2 * RunOptions::progress_interval);
  EXPECT_FALSE(result.discovery_time.has_value());
}

TEST(RunEnd, CountsIncludeWhatIsGeneratedButNotYetSent) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 10);
  const RunLog log = run_and_log(scenario);
  Counts sent;
  for (const Sent& packet : log.sent) {
    sent.spdp_multicast += packet.kind == PacketKind::spdp_multicast ? 1 : 0;
    sent.spdp_unicast += packet.kind == PacketKind::spdp_unicast ? 1 : 0;
    sent.acknack += packet.kind == PacketKind::acknack ? 1 : 0;
  }
  EXPECT_EQ(log.result.counts.spdp_multicast, sent.spdp_multicast);
  EXPECT_EQ(log.result.counts.spdp_unicast, sent.spdp_unicast);
  EXPECT_EQ(log.result.counts.acknack, sent.acknack);
  EXPECT_LT(log.arrived.size(), log.sent.size());
}

TEST(RunEnd, InitialDataOfACompleteRunIsTheStructuralWorkload) {
  for (const std::uint32_t endpoints : {0U, 1U, 7U}) {
    Scenario scenario;
    scenario.deployment = Deployment::homogeneous(3, 2, endpoints);
    const RunResult result = simulate(scenario);
    EXPECT_EQ(result.counts.initial_data, 3U * 2U * 4U * (17U + endpoints));
    EXPECT_EQ(result.useful_deliveries, result.counts.initial_data);
  }
}

TEST(EmptyStreams, ARelationWithoutDescriptorsStillExchangesControlMessages) {
  const RunLog log = run_and_log(by_hand({{0, 1}, {1, 0}, {1, 0, 500 * ms}}));
  EXPECT_EQ(log.times_of(PacketKind::heartbeat, 1, 0), std::vector<std::int64_t>{ms});
  const std::vector<Sent> acknacks = log.of(PacketKind::acknack, 0, 1);
  ASSERT_EQ(acknacks.size(), 1U);
  EXPECT_TRUE(acknacks[0].descriptors.empty());
  EXPECT_EQ(acknacks[0].payload_bytes, 64);
}

TEST(EmptyStreams, NothingToAdvertiseIsCompleteAtOnce) {
  const RunLog log = run_and_log(by_hand({{0, 0}, {1, 0}}));
  EXPECT_EQ(log.result.end, RunEnd::completed);
  EXPECT_EQ(log.result.discovery_time, Nanoseconds{0});
  EXPECT_EQ(log.result.counts, Counts{});
}

}  // namespace protocol_test
}  // namespace stormproof::model
