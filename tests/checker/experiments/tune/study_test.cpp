// Whole studies of small scenarios, and the reports about them.
#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/experiments/tune/comparison.hpp"
#include "checker/experiments/tune/deploy.hpp"
#include "checker/experiments/tune/model_runs.hpp"
#include "checker/experiments/tune/tune_report.hpp"
#include "checker/presentation/document/render.hpp"

namespace stormproof::tune {
namespace study_test {

const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

/// Two participants on each of two hosts over the emulated access point that all start at once,
/// with a send buffer so small that HEARTBEATs abound.
Subject small_storm(std::vector<std::string> more = {}) {
  std::vector<std::string> changes{
      "deployment.participants_per_host=2", "deployment.schedule.start=[0ms,3ms]",
      "deployment.schedule.endpoints_done=[0ms,3ms]",
      "dds={base: fastdds-2.6.11, sedp: {piggyback_threshold_bytes: 65507}}"};
  changes.insert(changes.end(), more.begin(), more.end());
  auto subject = read_subject("live-5x20", changes, "", specs);
  if (!subject) ADD_FAILURE() << to_string(subject.error());
  return subject ? *std::move(subject) : Subject{};
}

Options few_runs() {
  Options options;
  options.budget = 60;
  options.samples = 6;
  options.threads = 2;
  return options;
}

Report study(const Subject& subject, const Options& options) {
  auto report = tune(subject, options);
  if (!report) ADD_FAILURE() << to_string(report.error());
  return report ? *std::move(report) : Report{};
}

const Row* row_named(const Report& report, const std::string& name) {
  const auto found = std::ranges::find(report.rows, name, &Row::name);
  return found == report.rows.end() ? nullptr : &*found;
}

/// The study that several cases look at.
const Report& usual_study() {
  static const Report report = study(small_storm(), few_runs());
  return report;
}

std::string json_of(const Report& report, const Subject& subject, const Options& options) {
  return to_json(report, {.scenario = "small", .subject = subject, .options = options}).dump();
}

TEST(TuneStudy, FindsLessOfAStorm) {
  const Subject subject = small_storm();
  const Options options = few_runs();
  const Report& report = usual_study();
  ASSERT_EQ(report.answer, Answer::better);
  const Row& best = report.rows[*report.recommended];
  EXPECT_LT(*best.summary.completion_ns.median, *report.rows[0].summary.completion_ns.median);
  EXPECT_TRUE(best.against_unchanged->completion.is_less());
  EXPECT_TRUE(best.broken.empty());
  EXPECT_FALSE(best.changes.empty());
  for (const Change& change : best.changes) EXPECT_FALSE(change.setting.empty());
  ASSERT_NE(row_named(report, "send buffer 4 MB alone"), nullptr);
  ASSERT_NE(row_named(report, "adaptive HEARTBEATs"), nullptr);
  EXPECT_FALSE(row_named(report, "adaptive HEARTBEATs")->note.empty());

  const std::string text = report::to_text(
      document_of(report, {.scenario = "small", .subject = subject, .options = options}));
  EXPECT_TRUE(text.find("BETTER") != std::string::npos);
  EXPECT_TRUE(text.find("unchanged") != std::string::npos);
  const std::string svg =
      to_svg(report, {.scenario = "small", .subject = subject, .options = options});
  EXPECT_TRUE(svg.find("recommended") != std::string::npos);
  // In the legend, and beside its point, which may lie on another.
  const std::size_t named = svg.find(">adaptive HEARTBEATs<");
  ASSERT_TRUE(named != std::string::npos);
  EXPECT_TRUE(svg.find(">adaptive HEARTBEATs<", named + 1) != std::string::npos);
}

/// What the report says of the recommended setting is what its file gives.
TEST(TuneStudy, TheFileGivesTheNumbersAgain) {
  const Subject subject = small_storm();
  const Report& report = usual_study();
  ASSERT_TRUE(report.recommended);
  const Row& best = report.rows[*report.recommended];
  const auto xml = deployable(subject, best.scenario.dds, "a comment", specs);
  ASSERT_TRUE(xml) << to_string(xml.error());
  const auto profile = read_back(*xml, subject.preset, specs);
  ASSERT_TRUE(profile) << to_string(profile.error());
  model::Scenario scenario = subject.scenario;
  scenario.dds = *profile;
  const auto samples =
      trials::sample_runs(scenario, {report.basis.count, report.basis.first, {}, 1, {}});
  std::vector<double> completion, messages;
  for (const trials::Sample& sample : samples) {
    ASSERT_TRUE(sample.discovery_time);
    completion.push_back(static_cast<double>(sample.discovery_time->count()));
    messages.push_back(static_cast<double>(sample.counts.total()));
  }
  EXPECT_EQ(statistics::quantiles(completion).median, best.summary.completion_ns.median);
  EXPECT_EQ(statistics::quantiles(messages).median, best.summary.messages.median);
}

TEST(TuneStudy, TheFrontOfTheReportIsOne) {
  const Report& report = usual_study();
  ASSERT_GT(report.rows.size(), 2U);
  for (const Row& a : report.rows) {
    for (const Row& b : report.rows) {
      if (a.kind == Row::Kind::comparison || b.kind != Row::Kind::front) continue;
      const Cost one{*a.summary.completion_ns.median, *a.summary.messages.median};
      const Cost other{*b.summary.completion_ns.median, *b.summary.messages.median};
      EXPECT_FALSE(dominates(one, other)) << a.name << " dominates " << b.name;
    }
  }
}

TEST(TuneStudy, DoesNotDependOnThreads) {
  const Subject subject = small_storm();
  Options options = few_runs();
  options.threads = 1;
  const std::string one = json_of(study(subject, options), subject, options);
  EXPECT_EQ(one, json_of(usual_study(), subject, options));
  options.seed = 1;
  EXPECT_NE(one, json_of(study(subject, options), subject, options));
}

/// Who asks for a hundredfold gain gets none.
TEST(TuneStudy, SaysThatNothingIsBetter) {
  const Subject subject = small_storm();
  Options options = few_runs();
  options.least = 100;
  const Report report = study(subject, options);
  EXPECT_EQ(report.answer, Answer::nothing_better);
  EXPECT_EQ(report.recommended, std::optional<std::size_t>{0});
  const std::string text = report::to_text(
      document_of(report, {.scenario = "small", .subject = subject, .options = options}));
  EXPECT_TRUE(text.find("NOTHING BETTER") != std::string::npos);
}

TEST(TuneStudy, HoldsSettingsToTheLimitsOfTheScenario) {
  Options options = few_runs();
  options.keep = {"limit.messages"};
  const Report strict = study(small_storm({"limits.messages=1"}), options);
  EXPECT_EQ(strict.answer, Answer::nothing_better) << "no setting keeps it";
  EXPECT_GT(strict.found.rejected, 0U);
  EXPECT_TRUE(strict.found.front.empty());
}

TEST(TuneStudy, WhatBreaksUnchangedIsNotRequired) {
  const Report report = study(small_storm({"limits.messages=1"}), few_runs());
  EXPECT_EQ(report.answer, Answer::better);
  EXPECT_NE(std::ranges::find(report.not_required, "limit.messages"), report.not_required.end());
  EXPECT_NE(std::ranges::find(report.kept, "safety.snapshot"), report.kept.end());
}

TEST(TuneStudy, UnknownPropertiesAreRefused) {
  Options options = few_runs();
  options.keep = {"safety.snapshoot"};
  const auto report = tune(small_storm(), options);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("safety.snapshot"), std::string::npos);
}

TEST(TuneStudy, OneTrajectoryIsOneRun) {
  const auto subject =
      read_subject("smallest", std::vector<std::string>{"dds=fastdds-2.6.11"}, "", specs);
  ASSERT_TRUE(subject) << to_string(subject.error());
  Options options = few_runs();
  const Report report = study(*subject, options);
  EXPECT_FALSE(report.is_sampled);
  EXPECT_EQ(report.basis.count, 1U);
  const std::string text = report::to_text(
      document_of(report, {.scenario = "small", .subject = *subject, .options = options}));
  EXPECT_TRUE(text.find("one trajectory") != std::string::npos);
}

TEST(TuneStudy, InterruptedItTellsTheBestKnown) {
  const Subject subject = small_storm();
  Options options = few_runs();
  options.on_progress = [](std::string_view, std::size_t runs, std::size_t) { return runs < 40; };
  const Report report = study(subject, options);
  EXPECT_EQ(report.answer, Answer::interrupted);
  ASSERT_FALSE(report.rows.empty());
  const std::string text = report::to_text(
      document_of(report, {.scenario = "small", .subject = subject, .options = options}));
  EXPECT_TRUE(text.find("INTERRUPTED") != std::string::npos);
  options.on_progress = [](std::string_view, std::size_t, std::size_t) { return false; };
  EXPECT_EQ(study(subject, options).answer, Answer::interrupted);
}

TEST(TuneStudy, WhatThereIsNoTimeForIsNotAskedFor) {
  const Subject subject = small_storm();
  Options options = few_runs();
  options.budget = 100'000;
  options.samples = 1'000;
  const auto started = std::chrono::steady_clock::now();
  options.time = trials::Budget{[started] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - started;
    return std::optional{std::max(1.0 - passed.count(), 0.0)};
  }};
  const Report report = study(subject, options);
  EXPECT_TRUE(report.unasked.lacked_time());
  EXPECT_NE(report.answer, Answer::interrupted);
  EXPECT_LT(report.compared.count, options.samples);
  const std::string text = report::to_text(
      document_of(report, {.scenario = "small", .subject = subject, .options = options}));
  EXPECT_NE(text.find("to keep to --time"), std::string::npos);
  options.time = trials::Budget{[] { return std::optional{1e9}; }};
  options.budget = 50;
  options.samples = 6;
  EXPECT_FALSE(study(subject, options).unasked.lacked_time());
}

/// A row for the queue of the socket only where the channel has one that is smaller.
TEST(TuneComparison, TheQueueGrowsOnlyInARowOfItsOwn) {
  const Subject unlimited = small_storm();
  const Subject queued = small_storm({"wireless.source_queue_bytes=212992"});
  for (const Subject* subject : {&unlimited, &queued}) {
    const Space space =
        space_of(subject->scenario, model::config::vendor::vendor_knobs(subject->vendor));
    Point point = space.unchanged();
    point[*space.find("dds.sedp.piggyback_threshold_bytes")] = 4'000'000;
    const auto rows = rows_of(*subject, space, {point}, point);
    const model::Bytes queue = subject->scenario.wireless.source_queue_bytes;
    std::size_t grown = 0;
    for (const Row& row : rows) {
      if (row.scenario.wireless.source_queue_bytes == queue) continue;
      ++grown;
      EXPECT_EQ(row.kind, Row::Kind::comparison);
      EXPECT_EQ(row.scenario.wireless.source_queue_bytes, model::Bytes{4'000'000});
    }
    EXPECT_EQ(grown, subject == &queued ? 1U : 0U);
  }
}

}  // namespace study_test
}  // namespace stormproof::tune
