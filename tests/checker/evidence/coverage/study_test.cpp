// From rows to statistics: which runs take part, and that results do not depend on threads.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/coverage/report.hpp"
#include "checker/presentation/document/render.hpp"
#include "examples.hpp"

namespace stormproof::prediction {
namespace study_test {

StudyRequest request_of(const std::vector<std::string>& dds) {
  StudyRequest request;
  request.dds = dds;
  request.wireless = "emulated-ap";
  request.predict.samples = 3;
  return request;
}

std::vector<Observation> some_rows() {
  return read_text(R"({"set":"a","N_H":2,"N_P":1,"N_E":2,"T_app_ms":26,"medium":"ap"}
{"set":"a","N_H":2,"N_P":2,"N_E":4,"T_app_ms":110,"counts":{"total":264},"medium":"ap"}
{"set":"b","N_H":2,"N_P":1,"N_E":2,"T_app_ms":26,"medium":"veth"}
)")
      ->rows;
}

TEST(Study, RunsOfOtherChannelsAreSkippedAndCounted) {
  const auto result = study(some_rows(), {}, request_of({"fastdds-2.6.11", "paper"}));
  ASSERT_TRUE(result);
  const ProfileStudy& fastdds = result->profiles[0];
  EXPECT_EQ(fastdds.skipped.at("medium veth"), 1U);
  EXPECT_EQ(fastdds.configurations.size(), 2U);
  EXPECT_TRUE(fastdds.sampled);
  EXPECT_EQ(fastdds.predictions[0].values[0].size(), 3U);
  EXPECT_FALSE(result->profiles[1].sampled);
  EXPECT_EQ(result->profiles[1].predictions[0].values[0].size(), 1U);
}

TEST(Study, EveryRunCanBringItsChannel) {
  StudyRequest request = request_of({"fastdds-2.6.11"});
  request.channel = ChannelSource::row;
  const auto result = study(some_rows(), {}, request);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->profiles[0].configurations.size(), 3U);
}

/// One that creates its endpoints later completes later, and no run before the last creation.
TEST(Study, RunsHaveTheTimesOfTheirProcesses) {
  const std::string run = R"({"set":"a","N_H":2,"N_P":1,"N_E":2,"T_app_ms":26,"medium":"ap",)";
  const auto rows =
      read_text(run +
                R"("procs":[{"host":1,"enabled":2,"endpoints_done":300},)"
                R"({"host":0,"enabled":1.5,"endpoints_done":30}]})" +
                "\n" + run +
                R"("procs":[{"host":0,"id":0,"enabled":1,"endpoints_done":20},)"
                R"({"host":1,"id":0,"enabled":2,"endpoints_done":30}]})" +
                "\n" + run +
                R"("procs":[{"host":0,"enabled":1,"endpoints_done":20},)"
                R"({"host":0,"enabled":2,"endpoints_done":30}]})" +
                "\n" + run +
                R"("procs":[{"host":0,"enabled":1,"endpoints_done":20},{"host":1,"enabled":2}]})");
  ASSERT_TRUE(rows) << to_string(rows.error());
  const auto result = study(rows->rows, {}, request_of({"fastdds-2.6.11"}));
  ASSERT_TRUE(result);
  const ProfileStudy& profile = result->profiles[0];
  EXPECT_EQ(profile.measured_starts, 2U) << "the others do not say all";
  ASSERT_GE(profile.predictions[0].values[0].size(), 2U);
  EXPECT_GT(profile.predictions[0].values[0][0], 300);
  EXPECT_LT(profile.predictions[0].values[0][1], 300);
  EXPECT_NE(to_text(document_of({}, *result)).find("start as they did in 2 measured runs"),
            std::string::npos);
}

TEST(Study, EndsAtTheLimitOfARunThatDidNotComplete) {
  const auto rows = read_text(R"({"N_H":2,"N_P":5,"N_E":20,"completed":false,"limit_s":0.1,)"
                              R"("counts":{"total":2000}})")
                        ->rows;
  const auto result = study(rows, {}, request_of({"fastdds-2.6.11"}));
  ASSERT_TRUE(result);
  const Prediction& predicted = result->profiles[0].predictions[0];
  EXPECT_EQ(predicted.incomplete, 3U);
  EXPECT_EQ(predicted.values[0].front(), never);
  EXPECT_LT(predicted.values[1].front(), 20'000);  // counts up to 100 ms
  const FitRow& completion = result->profiles[0].rows.front();
  EXPECT_EQ(completion.fit.undecided_configurations, 1U);
}

TEST(Study, SameResultOnAnyNumberOfThreads) {
  StudyRequest request = request_of({"fastdds-2.6.11"});
  request.predict.threads = 1;
  const auto one = study(some_rows(), {}, request);
  request.predict.threads = 3;
  const auto three = study(some_rows(), {}, request);
  EXPECT_EQ(to_json({}, *one), to_json({}, *three));
  request.predict.first_seed = 3;
  EXPECT_NE(to_json({}, *one), to_json({}, *study(some_rows(), {}, request)));
}

TEST(Study, AnInterruptedOneSaysSo) {
  StudyRequest request = request_of({"fastdds-2.6.11"});
  request.predict.threads = 1;
  request.predict.on_progress = [](std::size_t finished, std::size_t) { return finished < 2; };
  const auto result = study(some_rows(), {}, request);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->interrupted);
  EXPECT_EQ(result->profiles[0].pairings().size(), 1U);
  EXPECT_NE(to_text(document_of({}, *result)).find("interrupted"), std::string::npos);
}

TEST(Study, AnUnknownProfileIsAnError) {
  const auto result = study(some_rows(), {}, request_of({"fastdds-9"}));
  ASSERT_FALSE(result);
  EXPECT_NE(to_string(result.error()).find("fastdds-9"), std::string::npos);
}

TEST(Study, JsonHasTheKeysThatScriptsUse) {
  const auto result = study(some_rows(), {}, request_of({"fastdds-2.6.11"}));
  const auto json = to_json({}, *result);
  bool found = false;
  for (const auto& row : json["rows"]) {
    found = found || (row["profile"] == "fastdds-2.6.11" && row["scope"] == "all" &&
                      row["class"] == "messages" && row["median_ratio"].is_number() &&
                      row["median_abs_ln_ratio"].is_number() && row["coverage"].is_number() &&
                      row["in_range"].is_number());
  }
  EXPECT_TRUE(found);
}

TEST(Study, ChartsAndPageForEachProfile) {
  const auto result = study(some_rows(), {}, request_of({"fastdds-2.6.11", "paper"}));
  std::vector<ChartFile> files = charts(result->profiles[0]);
  ASSERT_EQ(files.size(), 3U);
  for (const ChartFile& file : charts(result->profiles[1])) files.push_back(file);
  ASSERT_EQ(files.size(), 5U);  // the paper's single runs have no calibration
  EXPECT_EQ(files[2].name, "fastdds-2.6.11-calibration.svg");
  for (const ChartFile& file : files) EXPECT_NE(file.svg.find("<svg"), std::string::npos);
  EXPECT_NE(to_html(document_of({}, *result)).find("</html>"), std::string::npos);
}

}  // namespace study_test
}  // namespace stormproof::prediction
