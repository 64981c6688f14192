// What checks of several profiles share is what each of them would have found: of the rules of an
// implementation whatever the knobs, and of certificates that are the same word for word.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/tables/tables.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace shared_findings_test {

/// Of the tables' properties that several profiles may share something of.
constexpr std::array<std::string_view, 5> properties{
    "fsm.determinism", "fsm.totality", "fsm.reachability", "order.commutation", "live.no-stall"};

checker::Findings findings_of(const model::Scenario& scenario, checker::FoundOfRules* of_rules) {
  smt::Claims claims{{.second_solver = false}};
  checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
  request.of_rules = of_rules;
  return check(properties, request);
}

/// How long it took is not compared.
void expect_same(const checker::Findings& one, const checker::Findings& other) {
  ASSERT_EQ(one.size(), properties.size());
  ASSERT_EQ(other.size(), properties.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].first, other[k].first);
    EXPECT_EQ(one[k].second.kind, other[k].second.kind) << one[k].first;
    EXPECT_EQ(one[k].second.how, other[k].second.how) << one[k].first;
    EXPECT_EQ(one[k].second.details, other[k].second.details) << one[k].first;
    EXPECT_EQ(one[k].second.assumptions, other[k].second.assumptions) << one[k].first;
  }
}

/// Another profile of the same implementation.
void expect_sharing(const model::Scenario& first, const model::Scenario& second,
                    bool certificates_are_the_same) {
  const checker::Findings alone = findings_of(second, nullptr);
  checker::FoundOfRules of_rules;
  static_cast<void>(findings_of(first, &of_rules));
  const std::size_t found = of_rules.size();
  expect_same(findings_of(second, &of_rules), alone);
  EXPECT_EQ(of_rules.size() == found, certificates_are_the_same);
}

TEST(SharedFindings, OfProfilesThatDifferInNumbers) {
  model::Scenario slower = fastdds();
  slower.dds.sedp.heartbeat_period = slower.dds.sedp.heartbeat_period * 3;
  slower.dds.sedp.heartbeat_response_delay = model::Nanoseconds{10'000'000};
  slower.dds.sedp.nack_response_delay = model::Nanoseconds{100'000'000};
  slower.dds.sedp.nack_suppression_duration = model::Nanoseconds{10'000'000};
  slower.dds.sedp.piggyback_threshold_bytes = model::Bytes{4'000'000};
  expect_sharing(fastdds(), slower, true);
}

/// Whose rules choose otherwise has certificates of its own.
TEST(SharedFindings, OfProfilesThatDifferInRules) {
  model::Scenario pull = paper();
  pull.dds.sedp.initial_data = model::InitialData::pull;
  pull.dds.sedp.relation_opening = model::RelationOpening::each_side;
  pull.dds.sedp.acknowledge = model::Acknowledge::prefix;
  pull.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  pull.dds.sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
  expect_sharing(paper(), pull, false);
}

/// Nothing is taken from another implementation.
TEST(SharedFindings, OfTwoImplementations) { expect_sharing(paper(), fastdds(), false); }

/// A mutant is looked at by itself, and nobody believes what was found of it.
TEST(SharedFindings, NotOfMutants) {
  checker::FoundOfRules of_rules;
  const model::Scenario scenario = paper();
  smt::Claims claims{{.second_solver = false}};
  const checker::Mutant mutant{.id = "any", .description = "any", .rules = {}, .knobs = {}};
  checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = &mutant, .on_progress = {}};
  request.of_rules = &of_rules;
  constexpr std::array<std::string_view, 1> one{"fsm.determinism"};
  static_cast<void>(check(one, request));
  EXPECT_EQ(of_rules.size(), 0U);
}

}  // namespace shared_findings_test
}  // namespace stormproof::tables
