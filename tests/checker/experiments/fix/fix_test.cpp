// What cures a deployment, kind by kind: settings, only another way, only a launch plan, nothing
// needed, nothing that helps; what is kept is kept, and what was not run is no measurement.
#include "checker/experiments/fix/fix.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/fix/fix_report.hpp"
#include "checker/presentation/document/render.hpp"

namespace stormproof::fix {
namespace fix_test {

const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

/// A fleet that storms because its starts are spread.
Request storming() {
  Request request;
  request.scenario = "fleet-4x2x20";
  request.samples = 3;
  request.trials = 2;
  request.budget = 50;
  request.threads = 2;
  return request;
}

Report fixed(const Request& request) {
  auto report = fix(request, specs);
  EXPECT_TRUE(report) << to_string(report.error());
  return report ? *std::move(report) : Report{};
}

std::string text_of(const Report& report, const Request& request) {
  return report::to_text(document_of(report, request, {}));
}

bool says(const std::string& text, const char* what) {
  return text.find(what) != std::string::npos;
}

TEST(Fix, SettingsThatCureAreTheLeastChange) {
  const Request request = storming();
  const Report report = fixed(request);
  ASSERT_EQ(report.answer, Answer::cured);
  EXPECT_EQ(report.before.storms, 3U);
  const Attempt& cure = report.attempts[*report.chosen];
  EXPECT_EQ(cure.kind, Kind::settings);
  EXPECT_EQ(cure.name, "send buffer 4 MB");
  ASSERT_TRUE(cure.confirmed);
  EXPECT_EQ(cure.confirmed->storms, 0U);
  EXPECT_EQ(cure.confirmed->runs.front().seed, report.before.runs.front().seed);
  EXPECT_NE(cure.confirmed->runs.front().seed, cure.runs.runs.front().seed);
  const std::string text = text_of(report, request);
  EXPECT_TRUE(says(text, "CURED by send buffer 4 MB: STORM → FINE")) << text;
  EXPECT_TRUE(says(text, "a storm in 0 of 3 runs")) << text;

  const auto files = files_of(cure, request, specs);
  ASSERT_TRUE(files) << to_string(files.error());
  ASSERT_EQ(files->size(), 2U);
  EXPECT_TRUE(says(files->front().text, "<sendBufferSize>4000000"));
  EXPECT_TRUE(says(files->back().text, "net.core.wmem_max=4000000"));
  EXPECT_EQ(
      how_to_load(*files, "it's"),
      (std::vector<std::string>{
          "cd 'it'\\''s'", ". ./tuned.env  # on every robot, in the shell that starts ROS 2"}));
}

TEST(Fix, WhatIsKeptIsNotTouched) {
  Request request = storming();
  request.keep = {Kind::settings, Kind::discovery, Kind::vendor};
  const Report report = fixed(request);
  ASSERT_EQ(report.answer, Answer::cured);
  const Attempt& cure = report.attempts[*report.chosen];
  EXPECT_TRUE(std::ranges::all_of(report.attempts,
                                  [](const Attempt& made) { return made.kind == Kind::launch; }));
  EXPECT_TRUE(cure.plan || cure.candidate.id == "one-process") << cure.name;
  EXPECT_TRUE(cure.scenario.dds == report.candidates.scenario.dds ||
              cure.candidate.id == "one-process");
  const auto files = files_of(cure, request, specs);
  ASSERT_TRUE(files) << to_string(files.error());
  EXPECT_FALSE(files->empty());
}

/// Settings and plans leave what a lost announcement costs; a server is told by its clients.
TEST(Fix, AnotherWayIsTriedWhenSettingsDoNotCure) {
  Request request = storming();
  request.keep = {Kind::settings, Kind::launch};
  const Report report = fixed(request);
  ASSERT_EQ(report.answer, Answer::cured);
  const Attempt& cure = report.attempts[*report.chosen];
  EXPECT_TRUE(cure.kind == Kind::discovery || cure.kind == Kind::vendor) << cure.name;
  EXPECT_TRUE(std::ranges::none_of(report.attempts, [](const Attempt& made) {
    return made.kind == Kind::settings || made.kind == Kind::launch;
  }));
}

TEST(Fix, NothingNeededIsSaid) {
  Request request = storming();
  request.scenario = "smallest";
  request.overrides = {"dds=humble"};
  request.start_jitter = model::Nanoseconds{10'000'000};
  const Report report = fixed(request);
  EXPECT_EQ(report.answer, Answer::fine);
  EXPECT_TRUE(report.attempts.empty());
  EXPECT_TRUE(says(text_of(report, request), "NOTHING TO FIX: FINE"));
}

/// Nobody discovers anything within a millisecond.
TEST(Fix, WhatCuresNothingSaysWhatCameNearest) {
  Request request = storming();
  request.overrides = {"limits={completion: 1ms}"};
  request.keep = {Kind::settings, Kind::discovery};
  const Report report = fixed(request);
  EXPECT_EQ(report.answer, Answer::nothing_cures);
  ASSERT_TRUE(report.chosen);
  const std::string text = text_of(report, request);
  EXPECT_TRUE(says(text, "NOTHING CURES IT")) << text;
  EXPECT_TRUE(says(text, "Nearest comes")) << text;
  EXPECT_EQ(document_of(report, request, {}).exit_code, 1);
  const double median = *report.after()->completion.median;
  EXPECT_LT(median, *report.before.completion.median);
}

TEST(Fix, InterruptedItSaysOnlyWhatItKnows) {
  Request request = storming();
  request.on_progress = [](std::string_view, std::size_t, std::size_t) { return false; };
  Report report = fixed(request);
  EXPECT_EQ(report.answer, Answer::unfinished);
  EXPECT_TRUE(report.attempts.empty());
  EXPECT_TRUE(says(text_of(report, request), "INTERRUPTED before it was known what it is like"));
  request.on_progress = [](std::string_view doing, std::size_t, std::size_t) {
    return doing == "as it is";
  };
  report = fixed(request);
  EXPECT_EQ(report.answer, Answer::unfinished);
  EXPECT_EQ(report.before.runs.size(), 3U);
  EXPECT_FALSE(report.chosen);
  const std::string text = text_of(report, request);
  EXPECT_TRUE(says(text, "INTERRUPTED after 0 attempts: STORM before")) << text;
  EXPECT_EQ(document_of(report, request, {}).exit_code, 3);
}

/// With the last quarter of the time what was found is held against new seeds.
TEST(Fix, WhatThereIsNoTimeForIsSaid) {
  Request request = storming();
  request.keep = {Kind::settings};
  double left = 100;
  request.time = trials::Budget{[&left] { return std::optional{left}; }};
  request.on_progress = [&left](std::string_view doing, std::size_t, std::size_t) {
    if (doing == "as it is") left = 20;
    return true;
  };
  const Report report = fixed(request);
  EXPECT_EQ(report.answer, Answer::unfinished);
  EXPECT_EQ(report.untried, (std::vector{Kind::discovery, Kind::launch, Kind::vendor}));
  EXPECT_TRUE(report.attempts.empty());
  EXPECT_EQ(report.before.runs.size(), 3U);
  const std::string text = text_of(report, request);
  EXPECT_TRUE(says(text, "NO TIME LEFT after 0 attempts: STORM before")) << text;
  EXPECT_TRUE(says(text, "to keep to --time: no more changes of discovery, launch, vendor"))
      << text;
}

TEST(Fix, AProfileThatIsNoProductIsRefused) {
  Request request = storming();
  request.scenario = "wifi-5x20";
  const auto report = fix(request, specs);
  ASSERT_FALSE(report);
  EXPECT_TRUE(says(to_string(report.error()), "no product"));
}

}  // namespace fix_test
}  // namespace stormproof::fix
