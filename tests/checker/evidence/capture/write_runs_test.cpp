// A capture of a run agrees with the run: on the test vectors of both implementations, on random
// scenarios, on runs with losses and with deliberate mistakes; and what differs is noticed.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/scenarios.hpp"
#include "tests/checker/evidence/capture/write_comparison.hpp"
#include "tests/vectors/discovery_vectors.hpp"
#include "tests/vectors/fastdds_vectors.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::capture::testing {
namespace write_runs_test {

/// Both comparisons, with every size as the model has it.
void expect_agreement(const model::Scenario& scenario) {
  const auto [capture, emissions] = recorded(scenario);
  const Conversation conversation = conversation_in(capture);
  EXPECT_EQ(difference(scenario, capture.run, conversation), "");
  EXPECT_EQ(difference(scenario, emissions, conversation), "");
}

/// Those that a test has time for; the others differ in nothing but length.
template <class Vector>
std::vector<Vector> short_ones(std::vector<Vector> vectors) {
  constexpr std::int64_t most_heartbeats = 20'000;
  std::erase_if(vectors,
                [](const Vector& one) { return one.expected.heartbeat > most_heartbeats; });
  return vectors;
}

class WritePaper : public ::testing::TestWithParam<vectors::Vector> {};
TEST_P(WritePaper, CaptureAgreesWithTheRun) { expect_agreement(GetParam().scenario); }
INSTANTIATE_TEST_SUITE_P(Vector, WritePaper,
                         ::testing::ValuesIn(short_ones(vectors::paper_vectors())),
                         [](const auto& one) { return one.param.name; });

class WriteFastdds : public ::testing::TestWithParam<vectors::Vector> {};
TEST_P(WriteFastdds, CaptureAgreesWithTheRun) { expect_agreement(GetParam().scenario); }
INSTANTIATE_TEST_SUITE_P(Vector, WriteFastdds,
                         ::testing::ValuesIn(short_ones(vectors::fastdds_vectors())),
                         [](const auto& one) { return one.param.name; });

class WriteDiscovery : public ::testing::TestWithParam<vectors::DiscoveryVector> {};
TEST_P(WriteDiscovery, CaptureAgreesWithTheRun) { expect_agreement(GetParam().scenario); }
INSTANTIATE_TEST_SUITE_P(Vector, WriteDiscovery,
                         ::testing::ValuesIn(short_ones(vectors::discovery_vectors())),
                         [](const auto& one) { return one.param.name; });

/// Clients and super clients, with odd knobs.
TEST(WriteRandomWithServer, CaptureHasTheCountsAndTheTopologyOfTheRun) {
  constexpr std::uint64_t seeds = 60;
  std::size_t completed = 0;
  for (const model::Discovery discovery :
       {model::Discovery::server, model::Discovery::super_client}) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      model::Scenario scenario = props::draw_scenario(
          seed, static_cast<int>(seed), {.implementation = model::ImplementationKind::fastdds});
      props::draw_discovery(seed, discovery, scenario);
      model::RunOptions options;
      options.max_events = 20'000;
      const SimulatedCapture capture = simulated_capture(scenario, options);
      if (capture.run.counts.total() == 0) continue;
      completed += capture.run.completed() ? 1U : 0U;
      ASSERT_EQ(difference(scenario, capture.run, conversation_in(capture)), "") << "seed " << seed;
    }
  }
  EXPECT_GT(completed, seeds / 2);
}

TEST(WriteRuns, TheComparisonNoticesWhatAServerLeavesOut) {
  model::Scenario scenario = vectors::discovery_vectors().at(1).scenario;
  auto [capture, emissions] = recorded(scenario);
  const Conversation whole = conversation_in(capture);
  ASSERT_EQ(difference(scenario, capture.run, whole), "");
  for (const auto member :
       {&model::Counts::pdp_data, &model::Counts::pdp_heartbeat, &model::Counts::pdp_acknack,
        &model::Counts::gap, &model::Counts::initial_data, &model::Counts::repair_data}) {
    model::RunResult other = capture.run;
    ++(other.counts.*member);
    EXPECT_NE(difference(scenario, other, whole), "");
  }
  for (Emission& one : emissions) {
    if (one.kind != model::PacketKind::relayed || !one.relayed->has_data) continue;
    model::Relayed renumbered = *one.relayed;
    ++renumbered.number;
    one.relayed = std::make_shared<const model::Relayed>(renumbered);
    break;
  }
  EXPECT_NE(difference(scenario, emissions, whole), "");
}

/// Random sizes may be too small for a valid message, so datagrams may be larger than the model's.
RC_GTEST_PROP(WriteRandom, CaptureHasTheCountsAndTheTopologyOfTheRun, ()) {
  props::ScenarioSpace space;
  space.max_time_limit = model::Nanoseconds{2'000'000'000};
  const model::Scenario scenario = *props::scenarios(space);
  model::RunOptions options;
  options.max_events = 20'000;
  const SimulatedCapture capture = simulated_capture(scenario, options);
  if (capture.run.counts.total() == 0) return;  // nobody has started: no message to read
  RC_ASSERT(difference(scenario, capture.run, conversation_in(capture)) == "");
}

const model::Scenario& small_fastdds() { return vectors::fastdds_vectors().at(2).scenario; }

TEST(WriteRuns, WhatIsLostHasBeenSent) {
  model::Scenario scenario = small_fastdds();
  scenario.wireless.lost_packets = {4, 5, 20, 21, 22, 40};
  const SimulatedCapture correct = simulated_capture(small_fastdds());
  const SimulatedCapture capture = simulated_capture(scenario);
  EXPECT_NE(capture.run.counts, correct.run.counts);
  expect_agreement(scenario);
}

TEST(WriteRuns, AMistakeInTheRulesShowsInTheCapture) {
  model::Mutation twice;
  twice.events.push_back({.kind = model::EventKind::initial_acknack_due,
                          .change = model::EventMutation::Change::shift,
                          .by = model::Nanoseconds{-69'000'000},
                          .event_class = {}});
  model::RunOptions options;
  options.mutation = &twice;
  const SimulatedCapture correct = simulated_capture(small_fastdds());
  const SimulatedCapture mutated = simulated_capture(small_fastdds(), options);
  EXPECT_NE(mutated.run.counts, correct.run.counts);
  EXPECT_EQ(difference(small_fastdds(), mutated.run, conversation_in(mutated)), "");
  EXPECT_NE(difference(small_fastdds(), correct.run, conversation_in(mutated)), "");
}

TEST(WriteRuns, AnInterruptedRunIsACompleteFile) {
  model::RunOptions options;
  options.max_events = 100;
  const SimulatedCapture capture = simulated_capture(small_fastdds(), options);
  EXPECT_EQ(capture.run.end, model::RunEnd::interrupted);
  EXPECT_EQ(difference(small_fastdds(), capture.run, conversation_in(capture)), "");
}

TEST(WriteRuns, TheComparisonNoticesWhatIsLeftOut) {
  auto [capture, whole_run] = recorded(small_fastdds());
  std::vector<Emission> emissions = whole_run;
  const Conversation whole = conversation_in(capture);
  ASSERT_EQ(difference(small_fastdds(), emissions, whole), "");
  emissions.back().payload_bytes += 4;
  EXPECT_NE(difference(small_fastdds(), emissions, whole), "");
  emissions = whole_run;
  std::swap(emissions[0].source, emissions[1].source);
  EXPECT_NE(difference(small_fastdds(), emissions, whole), "");
  capture.pcap.resize(capture.pcap.size() / 2);
  const Conversation half = conversation_in(capture);
  EXPECT_NE(difference(small_fastdds(), capture.run, half), "");
  EXPECT_NE(difference(small_fastdds(), whole_run, half), "");
}

}  // namespace write_runs_test
}  // namespace stormproof::capture::testing
