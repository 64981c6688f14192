// Guards the directions of the predictions on specs/findings/interventions.md, on one deployment
// with fixed seeds, and the fit that specs/guide/coverage.md states, on the smaller configurations.
#include <fstream>

#include <gtest/gtest.h>

#include "checker/evidence/coverage/study.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::prediction {
namespace intervention_test {

const std::string specs = STORMPROOF_SOURCE_DIR "/specs/";

/// Median over five schedules of live-5x20, with changes.
double median_of(Measure measure, const std::vector<std::string>& overrides) {
  const auto scenario =
      model::config::read_scenario("live-5x20", overrides, model::config::SpecPath::standard());
  EXPECT_TRUE(scenario);
  const std::vector<Case> cases{{*scenario, 0, {}}};
  PredictOptions options;
  options.samples = 5;
  const Predictions predictions = predict(cases, options);
  return quantile(predictions.cases[0].values[static_cast<std::size_t>(measure)], 0.5);
}

std::vector<Observation> rows_of(const std::string& file, const std::vector<std::string>& select) {
  std::ifstream input{specs + "observations/" + file};
  const auto read = read_observations(input, file, {CompletionTime::app, select});
  EXPECT_TRUE(read);
  return read->rows;
}

TEST(Interventions, LargeSendBufferRemovesHeartbeats) {
  const double usual = median_of(Measure::heartbeat, {});
  EXPECT_GT(usual, 5 * median_of(Measure::heartbeat, {"dds=fastdds-2.6.11-sndbuf4M"}));
}

TEST(Interventions, LinearAccountingRemovesHeartbeats) {
  const double usual = median_of(Measure::heartbeat, {});
  EXPECT_GT(usual, 5 * median_of(Measure::heartbeat, {"dds.sedp.piggyback=linear"}));
}

TEST(Interventions, AnsweringOnlyTheNewParticipantMakesTheStormWorse) {
  EXPECT_GT(median_of(Measure::messages, {"dds.spdp.resend=new_only"}),
            median_of(Measure::messages, {}));
}

TEST(Interventions, LongerTimersShortenDiscovery) {
  EXPECT_LT(median_of(Measure::messages, {"dds=fastdds-2.14.5"}), median_of(Measure::messages, {}));
}

TEST(Interventions, TheLiveRunsConfirmLinearAccounting) {
  StudyRequest request;
  request.dds = {specs + "findings/profiles/linear.yaml"};
  request.baseline = "fastdds-2.6.11";
  request.wireless = "emulated-ap";
  request.scopes = {"np4"};
  request.predict.samples = 4;
  const auto result = study(rows_of("interventions.jsonl", {"variant=V4", "N_P=4"}),
                            rows_of("interventions.jsonl", {"variant=V0", "N_P=4"}), request);
  ASSERT_TRUE(result);
  for (const Effect& e : result->profiles[0].effects) {
    if (e.measure != Measure::heartbeat) continue;
    EXPECT_EQ(e.verdict, EffectVerdict::confirmed);
    EXPECT_LT(e.observed->high, 0.5);
  }
}

TEST(LiveRuns, ArePredictedWithinTheStatedError) {
  StudyRequest request;
  request.dds = {"fastdds-2.6.11"};
  request.wireless = "emulated-ap";
  request.scopes = {"all"};
  request.predict.samples = 4;
  std::vector<Observation> rows;
  for (const Observation& run : rows_of("fastdds-2.6.11-ap150.jsonl", {"set=ap150"})) {
    if (run.participants_per_host <= 4) rows.push_back(run);
  }
  const auto result = study(rows, {}, request);
  ASSERT_TRUE(result);
  const std::vector<FitRow>& fits = result->profiles[0].rows;
  ASSERT_EQ(fits.size(), statistics::discovery_measure_count);
  EXPECT_LE(fits[0].fit.median_abs_ln_ratio, 0.15);  // completion
  EXPECT_LE(fits[1].fit.median_abs_ln_ratio, 0.2);   // all messages
}

}  // namespace intervention_test
}  // namespace stormproof::prediction
