// The findings of specs/findings: laws that one would expect and that are false. Each test shows
// that the counterexample still is one, with the numbers of its page.
#include <gtest/gtest.h>

#include "tests/props/laws/law_check.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace law_findings_test {

model::RunResult run_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const std::string path = std::string{STORMPROOF_SPECS_DIR "/findings"} + "/" + name + ".yaml";
  return correct(shipped(path, overrides), nullptr);
}

std::int64_t t_disc(const model::RunResult& result) {
  EXPECT_TRUE(result.completed());
  return result.discovery_time ? result.discovery_time->count() : -1;
}

std::int64_t t_disc(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return t_disc(run_of(name, overrides));
}

TEST(Findings, ALostPacketCompletesDiscoveryEarlier) {
  EXPECT_EQ(t_disc("loss-completes-earlier"), 104'100'000);
  EXPECT_EQ(t_disc("loss-completes-earlier", {"wireless.lost_packets=[4]"}), 73'100'000);
}

/// On a channel that never idles the gain is exactly the airtime saved.
TEST(Findings, OnABusyChannelALossGainsTheAirtimeThatItSaves) {
  const model::RunResult one = correct(shipped("smallest"), nullptr);
  const model::RunResult other =
      correct(shipped("smallest", {"wireless.lost_packets=[5]"}), nullptr);
  EXPECT_EQ(t_disc(one), 16'136'228);
  EXPECT_EQ(t_disc(other), 15'452'672);
  EXPECT_EQ(one.counts.repair_data, 38U);
  EXPECT_EQ(other.counts.repair_data, 28U);
  EXPECT_EQ(one.channels.front().total_busy().count(), t_disc(one));
  EXPECT_EQ(other.channels.front().total_busy().count(), t_disc(other));
}

TEST(Findings, TheOrderOfParticipantsMatters) {
  EXPECT_EQ(t_disc("participant-order"), 19'610'620);
  EXPECT_EQ(t_disc("participant-order",
                   {"deployment.participants=[{host: 1, publications: 0, subscriptions: 0}, "
                    "{host: 0, publications: 10, subscriptions: 0}]"}),
            20'673'440);
}

TEST(Findings, ALargerQueueIsSlower) {
  EXPECT_EQ(t_disc("larger-queue-slower"), 1'175'744'832);
  EXPECT_EQ(t_disc("larger-queue-slower", {"wireless.source_queue_bytes=20000"}), 377'051'781);
  const model::RunResult alone = run_of("larger-queue-slower", {"wireless.source_queue_bytes=1"});
  EXPECT_EQ(t_disc(alone), 294'544'898);
  EXPECT_EQ(alone.counts.repair_data, 0U);
}

TEST(Findings, OneEndpointMoreCompletesSooner) {
  const model::RunResult fewer = run_of("more-endpoints-sooner");
  const model::RunResult more =
      run_of("more-endpoints-sooner", {"deployment.endpoints_per_participant=20"});
  EXPECT_EQ(t_disc(fewer), 1'442'502'054);
  EXPECT_EQ(t_disc(more), 1'175'744'832);
  EXPECT_GT(more.counts.total(), fewer.counts.total());
}

TEST(Findings, TimeDoesNotScaleExactly) {
  const model::RunResult scaled = run_of("time-scaling");
  EXPECT_EQ(t_disc(scaled), 2 * 16'136'228 + 8);
  EXPECT_EQ(scaled.counts, correct(shipped("smallest"), nullptr).counts);
}

}  // namespace law_findings_test
}  // namespace stormproof::props
