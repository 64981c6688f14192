// Every tiny run of the simulator is explored, and everything that is explored is a run: for the
// paper's writer with each of its knobs, and for Fast DDS's (the harness is enumeration.hpp; the
// third composition has a test beside its own).
#include "tests/checker/engines/explorer/enumeration.hpp"

#include "checker/engines/explorer/relation_world.hpp"
#include "model/fastdds/endpoints.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace enumeration_test {

using model::Nanoseconds;

struct Case {
  const char* name;
  std::int64_t delay;
  unsigned losses;
  std::uint64_t least_runs;  ///< so that the test is not about next to nothing
  void (*change)(model::SedpProfile&, Scope&) = [](model::SedpProfile&, Scope&) {};
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

model::Scenario tiny_case(const Case& c, model::ImplementationKind implementation, Scope& scope) {
  model::Scenario scenario = tiny_scenario();
  scenario.dds.implementation = implementation;
  // With `bitmap` initial ACKNACKs may go on forever after a loss.
  scenario.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  scope.losses = c.losses;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{c.delay};
  scope.leaves_within = Nanoseconds{1};
  c.change(scenario.dds.sedp, scope);
  return scenario;
}

class PaperRuns : public testing::TestWithParam<Case> {};

TEST_P(PaperRuns, HaveTheOutcomesOfTheExplorer) {
  Scope scope;
  const model::Scenario scenario = tiny_case(GetParam(), model::ImplementationKind::paper, scope);
  EXPECT_GT(expect_equal_outcomes<RelationWorld>(scenario, scope), GetParam().least_runs);
}

using Sedp = model::SedpProfile;

INSTANTIATE_TEST_SUITE_P(
    Tiny, PaperRuns,
    testing::Values(Case{"no_loss", 3, 0, 200},
                    Case{"no_loss_asks_early", 3, 0, 300,
                         [](Sedp& sedp, Scope&) { sedp.initial_acknack_delay = Nanoseconds{2}; }},
                    Case{"one_loss", 2, 1, 150}, Case{"one_loss_long_delay", 3, 1, 2000},
                    Case{"one_loss_asks_early", 2, 1, 200,
                         [](Sedp& sedp, Scope&) { sedp.initial_acknack_delay = Nanoseconds{3}; }},
                    Case{"one_loss_asks_again_and_again", 2, 1, 200,
                         [](Sedp& sedp, Scope&) {
                           sedp.initial_acknack_delay = Nanoseconds{2};
                           sedp.initial_acknack_interval = model::InitialAckNackInterval::constant;
                         }},
                    Case{"two_packets", 3, 0, 100,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.grouping = model::Grouping::single;
                           scope.descriptors = 2;
                         }},
                    Case{"two_packets_one_loss", 1, 1, 10,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.grouping = model::Grouping::single;
                           scope.descriptors = 2;
                         }},
                    Case{"pull", 2, 0, 20,
                         [](Sedp& sedp, Scope&) { sedp.initial_data = model::InitialData::pull; }},
                    Case{"pull_one_loss", 2, 1, 100,
                         [](Sedp& sedp, Scope&) { sedp.initial_data = model::InitialData::pull; }},
                    Case{"each_side", 2, 0, 100,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.relation_opening = model::RelationOpening::each_side;
                           sedp.initial_acknack_delay = Nanoseconds{2};
                           scope.side_by_side = true;
                         }},
                    Case{"each_side_accepts_unmatched", 2, 0, 100,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.relation_opening = model::RelationOpening::each_side;
                           sedp.unmatched = model::Unmatched::accept;
                           scope.side_by_side = true;
                         }},
                    Case{"prefix", 2, 0, 20,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.acknowledge = model::Acknowledge::prefix;
                           sedp.grouping = model::Grouping::single;
                           scope.descriptors = 2;
                         }},
                    Case{"prefix_one_loss", 1, 1, 10,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.acknowledge = model::Acknowledge::prefix;
                           sedp.grouping = model::Grouping::single;
                           scope.descriptors = 2;
                         }},
                    Case{"matched_one_loss", 2, 1, 100,
                         [](Sedp& sedp, Scope&) {
                           sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
                         }},
                    Case{"additive_one_loss", 2, 1, 100,
                         [](Sedp& sedp, Scope&) {
                           sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
                         }},
                    Case{"piggyback_linear", 2, 0, 50,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.piggyback = model::Piggyback::linear;
                           sedp.piggyback_threshold_bytes = model::Bytes{500};
                           sedp.grouping = model::Grouping::single;
                           scope.descriptors = 2;
                         }},
                    Case{"piggyback_cumulative_one_loss", 1, 1, 10,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.piggyback = model::Piggyback::cumulative;
                           sedp.piggyback_threshold_bytes = model::Bytes{1'000};
                           scope.descriptors = 2;
                         }},
                    Case{"a_large_budget_need_not_be_counted", 2, 1, 100,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.piggyback = model::Piggyback::cumulative;
                           scope.counts_bytes = false;
                         }},
                    Case{"two_readers", 2, 0, 100, [](Sedp&, Scope& scope) { scope.readers = 2; }},
                    Case{"two_readers_one_loss", 1, 1, 10,
                         [](Sedp&, Scope& scope) { scope.readers = 2; }},
                    Case{"three_readers_one_loss", 1, 1, 10,
                         [](Sedp&, Scope& scope) { scope.readers = 3; }},
                    Case{"two_readers_one_joins_later", 1, 1, 10,
                         [](Sedp&, Scope& scope) {
                           scope.readers = 2;
                           scope.joins_within = Nanoseconds{2};
                         }},
                    Case{"two_readers_piggyback", 1, 0, 0,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.piggyback = model::Piggyback::linear;
                           sedp.piggyback_threshold_bytes = model::Bytes{500};
                           scope.readers = 2;
                         }},
                    Case{"two_writers", 2, 0, 100, [](Sedp&, Scope& scope) { scope.writers = 2; }},
                    Case{"two_writers_one_loss", 1, 1, 40,
                         [](Sedp&, Scope& scope) { scope.writers = 2; }},
                    Case{"two_writers_count_bytes_together", 1, 1, 40,
                         [](Sedp& sedp, Scope& scope) {
                           sedp.piggyback = model::Piggyback::cumulative;
                           sedp.piggyback_threshold_bytes = model::Bytes{1'000};
                           scope.writers = 2;
                         }}),
    [](const auto& test) { return std::string{test.param.name}; });

TEST(TinyRuns, ShowTheIntervalOfInitialAckNacks) {
  Case c{"", 2, 1, 0, [](Sedp& sedp, Scope&) { sedp.initial_acknack_delay = Nanoseconds{2}; }};
  Scope scope;
  model::Scenario scenario = tiny_case(c, model::ImplementationKind::paper, scope);
  const Outcomes doubling = explored<RelationWorld>(scenario, scope);
  scenario.dds.sedp.initial_acknack_interval = model::InitialAckNackInterval::constant;
  EXPECT_NE(explored<RelationWorld>(scenario, scope).ends, doubling.ends);
}

class FastDdsRuns : public testing::TestWithParam<Case> {};

TEST_P(FastDdsRuns, HaveTheOutcomesOfTheExplorer) {
  Scope scope;
  scope.descriptors = model::fastdds::default_publications;
  model::Scenario scenario = tiny_case(GetParam(), model::ImplementationKind::fastdds, scope);
  scope.leaves_within = Nanoseconds{0};
  EXPECT_GT(expect_equal_outcomes<RelationWorld>(scenario, scope), GetParam().least_runs);
}

INSTANTIATE_TEST_SUITE_P(
    Tiny, FastDdsRuns,
    testing::Values(
        Case{"no_loss", 3, 0, 50},
        Case{"no_loss_asks_early", 2, 0, 50,
             [](Sedp& sedp, Scope&) { sedp.initial_acknack_delay = Nanoseconds{2}; }},
        Case{"one_loss", 2, 1, 100},
        Case{"the_two_sides_open_apart", 2, 0, 100,
             [](Sedp& sedp, Scope& scope) {
               sedp.initial_acknack_delay = Nanoseconds{2};
               scope.side_by_side = true;
             }},
        Case{"one_created_later", 2, 0, 50, [](Sedp&, Scope& scope) { scope.pushed = 1; }},
        Case{"one_created_later_one_loss", 1, 1, 10, [](Sedp&, Scope& scope) { scope.pushed = 1; }},
        Case{"two_messages", 1, 1, 10,
             [](Sedp& sedp, Scope&) { sedp.grouping_limit_bytes = model::Bytes{2'400}; }},
        Case{"two_readers", 1, 1, 10, [](Sedp&, Scope& scope) { scope.readers = 2; }},
        Case{"three_readers", 1, 1, 10, [](Sedp&, Scope& scope) { scope.readers = 3; }},
        Case{"two_writers", 1, 1, 10, [](Sedp&, Scope& scope) { scope.writers = 2; }},
        Case{"two_writers_two_messages", 1, 0, 0,
             [](Sedp& sedp, Scope& scope) {
               sedp.grouping_limit_bytes = model::Bytes{2'400};
               scope.writers = 2;
             }}),
    [](const auto& test) { return std::string{test.param.name}; });

}  // namespace enumeration_test
}  // namespace stormproof::explorer
