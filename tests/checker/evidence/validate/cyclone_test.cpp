// Runs of Cyclone DDS beside captures of it: what a run's messages are counted as, by the rules of
// captures, is what the run itself counts; shipped captures are predicted, and the wrong
// implementation is told apart.
#include <set>

#include <gtest/gtest.h>

#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "checker/evidence/validate/message_tally.hpp"
#include "checker/evidence/validate/validate.hpp"
#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"
#include "tests/checker/evidence/capture/write_comparison.hpp"
#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/vectors/cyclone_vectors.hpp"

namespace stormproof::validate {
namespace cyclone_test {

using model::MessageClass;

std::uint64_t of(const Tally& tally, Figure figure) { return tally[index_of(figure)]; }

TEST(CycloneTally, CountsWhatTheRunCounts) {
  for (const vectors::Vector& vector : vectors::cyclone_vectors()) {
    MessageTally tally{vector.scenario.dds, 1'000'000, 100};
    model::RunOptions options;
    options.probe = &tally;
    const model::RunResult run = model::simulate(vector.scenario, options);
    for (const MessageClass one : model::message_classes) {
      EXPECT_EQ(of(tally.tally(), figure_of(one)), run.counts[one]) << vector.name;
    }
    EXPECT_EQ(of(tally.tally(), Figure::total), run.counts.total()) << vector.name;
    EXPECT_EQ(of(tally.tally(), Figure::acknack_initial) +
                  of(tally.tally(), Figure::acknack_negative) +
                  of(tally.tally(), Figure::acknack_positive),
              run.counts.acknack)
        << vector.name;
    EXPECT_LE(of(tally.tally(), Figure::initial_pulled), run.counts.initial_data) << vector.name;
    EXPECT_GT(of(tally.tally(), Figure::initial_pulled), 0U) << vector.name;
    EXPECT_LT(of(tally.tally(), Figure::user_control), run.user_control)
        << vector.name << ": DATA is not among it";
  }
}

/// A run written as a capture, and read and predicted as any other: whatever is counted differently
/// on the two sides shows here.
class SimulatedCyclone : public ::testing::TestWithParam<const char*> {};

TEST_P(SimulatedCyclone, IsPredictedExactly) {
  constexpr const char* text = R"({
    deployment: {participants: [
      {host: 0, publications: 3, subscriptions: 2, start: 0ms, endpoints_done: 20ms},
      {host: 0, publications: 1, subscriptions: 4, start: 5ms, endpoints_done: 20ms},
      {host: 0, publications: 2, subscriptions: 2, start: 9ms, endpoints_done: 20ms},
      {host: 1, publications: 0, subscriptions: 2, start: 2ms, endpoints_done: 20ms},
      {host: 1, publications: 2, subscriptions: 2, start: 7ms, endpoints_done: 20ms}]},
    dds: cyclonedds-0.10, wireless: {base: emulated-ap, overhead_unicast: 700us}, time_limit: 100s})";
  const std::vector<std::string> overrides{std::string{"dds="} + GetParam()};
  const auto scenario =
      model::config::parse_scenario(text, "test", overrides, model::config::SpecPath::standard());
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const auto written = capture::simulated_capture(*scenario);
  ASSERT_TRUE(written.run.completed());
  const auto conversation = capture::testing::conversation_in(written);
  EXPECT_TRUE(conversation.remarks.empty());
  Request request;
  request.dds = GetParam();
  request.wireless = "emulated-ap";
  request.overrides = {"wireless.overhead_unicast=700us"};
  request.endpoints_done = {model::Nanoseconds{20'000'000}, model::Nanoseconds{20'000'000}};
  request.sampling.samples = 2;
  request.sampling.threads = 1;
  const auto report = validate(conversation, request);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_TRUE(report->observation.complete);
  EXPECT_GT(report->observation.values[index_of(Figure::repair_data)], 0);
  for (const Row& row : report->rows) {
    if (!row.median) continue;
    EXPECT_EQ(*row.median, row.observed) << name_of(row.figure);
  }
  EXPECT_TRUE(report->differences.empty()) << report->differences.front().text;
}

INSTANTIATE_TEST_SUITE_P(Profiles, SimulatedCyclone,
                         ::testing::Values("cyclonedds-0.10", "cyclonedds-0.10-multicast"),
                         [](const auto& tested) {
                           return std::string{tested.index == 0 ? "spdp" : "multicast"};
                         });

Report report_of(const std::string& capture, const std::string& dds) {
  Request request;
  request.dds = dds;
  request.wireless = capture.find("veth") != std::string::npos ? "wired" : "emulated-ap";
  request.sampling.samples = 4;
  request.sampling.threads = 1;
  const auto report = validate(conform::testing::shipped(capture), request);
  EXPECT_TRUE(report) << to_string(report.error());
  return *report;
}

const Row& row_of(const Report& report, Figure figure) { return report.rows[index_of(figure)]; }

TEST(CycloneCapture, IsPredicted) {
  const Report report = report_of("cyclone0102uni_ap_np5_ne20_r0", "cyclonedds-0.10");
  EXPECT_EQ(report.complete, report.runs);
  for (const Figure figure : {Figure::completion, Figure::total, Figure::initial_data}) {
    ASSERT_TRUE(row_of(report, figure).ratio) << name_of(figure);
    EXPECT_GT(*row_of(report, figure).ratio, 0.4) << name_of(figure);
    EXPECT_LT(*row_of(report, figure).ratio, 2.5) << name_of(figure);
  }
  EXPECT_FALSE(row_of(report, Figure::heartbeat_periodic).median);
  std::set<std::string> found;
  for (const Difference& difference : report.differences) found.insert(difference.id);
  EXPECT_FALSE(found.contains("other-vendor"));
  EXPECT_FALSE(found.contains("multicast-sedp"));
}

TEST(CycloneCapture, OfAnotherImplementationDiffers) {
  std::set<std::string> found;
  for (const Difference& difference :
       report_of("cyclone0102_veth_np2_ne20_r0", "fastdds-2.6.11").differences) {
    found.insert(difference.id);
  }
  EXPECT_TRUE(found.contains("other-vendor"));
  EXPECT_TRUE(found.contains("multicast-sedp"));
}

}  // namespace cyclone_test
}  // namespace stormproof::validate
