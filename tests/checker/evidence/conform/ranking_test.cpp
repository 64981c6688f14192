// Ranks the shipped profiles by shipped captures, of which it is known who sent them.
#include "checker/evidence/conform/ranking.hpp"

#include <gtest/gtest.h>

#include "checker/evidence/conform/report/ranking_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/checker/evidence/conform/captures.hpp"

namespace stormproof::conform {
namespace ranking_test {

using testing::profile;
using testing::shipped;

std::vector<Candidate> profiles() {
  const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};
  std::vector<Candidate> all;
  for (const std::string& name : specs.names(model::config::SpecKind::dds)) {
    all.push_back({name, *model::config::read_dds_profile(name, {}, specs)});
  }
  return all;
}

std::string answer(const capture::Conversation& conversation, const Ranking& ranking) {
  return document_of(RankingReport{conversation, ranking, {}, INT64_MAX, {}, {}}).answer.plain();
}

TEST(Ranking, FindsTheVersionThatSentIt) {
  const auto conversation = shipped("fastdds291_ap_np3_ne10_r0");
  const auto ranking = rank({conversation, INT64_MAX, {}, profiles()});
  ASSERT_TRUE(ranking) << to_string(ranking.error());
  EXPECT_EQ(ranking->verdict(), Verdict::conforms);
  EXPECT_EQ(ranking->best, 1U);
  EXPECT_EQ(ranking->ranked.size(), 14U);
  // Those whose messages are not followed, with the reason of each.
  std::vector<std::string> not_held;
  for (const NotHeld& one : ranking->not_held) not_held.push_back(one.name);
  EXPECT_EQ(not_held, (std::vector<std::string>{"fastdds-2.6.11-relations", "paper"}));
  EXPECT_EQ(answer(conversation, *ranking),
            "fastdds-2.9.1 explains every message, and no other shipped profile does");
}

TEST(Ranking, SaysWhenTheCaptureDoesNotTell) {
  const auto conversation = shipped("fastdds2611_ap150_np1_ne2_r0");
  const auto ranking = rank({conversation, INT64_MAX, {}, profiles()});
  ASSERT_TRUE(ranking);
  EXPECT_EQ(ranking->verdict(), Verdict::conforms);
  ASSERT_GT(ranking->best, 1U);
  for (std::size_t k = 0; k < ranking->best; ++k) {
    EXPECT_EQ(ranking->ranked[k].result.verdict, Verdict::conforms);
  }
  EXPECT_NE(answer(conversation, *ranking).find("this capture does not tell them apart"),
            std::string::npos);
}

TEST(Ranking, FindsCyclone) {
  const auto conversation = shipped("cyclone0102_veth_np2_ne20_r0");
  const auto ranking = rank({conversation, INT64_MAX, {}, profiles()});
  ASSERT_TRUE(ranking);
  EXPECT_EQ(ranking->verdict(), Verdict::conforms);
  EXPECT_EQ(ranking->ranked.front().name, "cyclonedds-0.10-multicast");
}

/// Whoever tried one profile has not found out that no other one fits.
TEST(Ranking, SaysAfterHowManyProfilesItWasInterrupted) {
  const auto conversation = shipped("cyclone0102_veth_np2_ne20_r0");
  RankingRequest request{conversation, INT64_MAX, {}, profiles()};
  std::string first;
  request.progress = [&first](const std::string& name, std::size_t, std::size_t) {
    if (first.empty()) first = name;
    return name == first;
  };
  const auto ranking = rank(request);
  ASSERT_TRUE(ranking);
  EXPECT_EQ(ranking->ranked.size(), 1U);
  EXPECT_EQ(ranking->left_out, 13U);
  EXPECT_TRUE(answer(conversation, *ranking).starts_with("INTERRUPTED after 1 of 14 profiles"))
      << answer(conversation, *ranking);
  EXPECT_FALSE(document_of(RankingReport{conversation, *ranking, {}, INT64_MAX, {}, {}}).complete);
}

TEST(Ranking, ComesClosestIfNothingFits) {
  const auto conversation = shipped("cyclone0102_veth_np2_ne20_r0");
  std::vector<Candidate> of_fastdds = profiles();
  std::erase_if(of_fastdds,
                [](const Candidate& one) { return one.name.starts_with("cyclonedds"); });
  const auto ranking = rank({conversation, INT64_MAX, {}, std::move(of_fastdds)});
  ASSERT_TRUE(ranking);
  EXPECT_EQ(ranking->verdict(), Verdict::does_not_conform);
  EXPECT_TRUE(answer(conversation, *ranking).starts_with("No shipped profile explains"));
}

TEST(Ranking, TimeThatIsOverIsInconclusive) {
  const auto conversation = shipped("fastdds2611_ap150_np1_ne2_r0");
  const auto ranking =
      rank({conversation, INT64_MAX, {}, profiles(), std::chrono::milliseconds{-1}});
  ASSERT_TRUE(ranking);
  EXPECT_EQ(ranking->verdict(), Verdict::inconclusive);
  EXPECT_EQ(ranking->best, 1U);
  EXPECT_TRUE(ranking->ranked.front().result.why_inconclusive.starts_with("not done after"));
}

TEST(Ranking, Stops) {
  const auto conversation = shipped("fastdds2611_ap150_np1_ne2_r0");
  RankingRequest request{conversation, INT64_MAX, {}, profiles()};
  request.progress = [](const std::string&, std::size_t, std::size_t) { return false; };
  const auto ranking = rank(request);
  ASSERT_TRUE(ranking);
  EXPECT_TRUE(ranking->ranked.empty());  // half of a profile is none
  EXPECT_EQ(ranking->left_out, 14U);
  EXPECT_EQ(ranking->verdict(), Verdict::inconclusive);
  EXPECT_EQ(answer(conversation, *ranking), "INTERRUPTED after 0 of 14 profiles");
}

TEST(Vacuous, ACaptureCutBeforeTheFirstDescriptorDecidesNothing) {
  const auto conversation = shipped("fastdds2611_ap150_np1_ne2_r0");
  Request request{conversation, conversation.first_ns, profile("fastdds-2.6.11"), {}, {}};
  const auto result = conform(request);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->verdict, Verdict::inconclusive);
  EXPECT_EQ(result->why_inconclusive,
            "next to nothing was checked: no descriptor (SEDP DATA) is among the 1 events");
  request.until_ns = INT64_MAX;
  EXPECT_EQ(conform(request)->verdict, Verdict::conforms);
}

}  // namespace ranking_test
}  // namespace stormproof::conform
