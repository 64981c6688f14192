// Replays of traces that are right, changed, or not complete.
#include "model/trace/replay.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/model/config/test_files.hpp"
#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace replay_test {

class Replaying {
 public:
  /// Replays a file with this text; the text must be readable.
  Replay operator()(const std::string& text) const {
    const auto result = replay(files_.write("run.jsonl", text), config::source_specs());
    EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
    return result ? *result : Replay{};
  }

 private:
  config::TestFiles files_;
};

/// Replaces the first occurrence in a line.
void replace(std::string& line, const std::string& from, const std::string& to) {
  const std::size_t found = line.find(from);
  ASSERT_NE(found, std::string::npos) << line;
  line.replace(found, from.size(), to);
}

class ReplayTest : public testing::TestWithParam<Case> {};

TEST_P(ReplayTest, ATraceHappensAgain) {
  const Recording& trace = recorded(GetParam());
  const Replay replay = Replaying{}(trace.text);
  EXPECT_EQ(replay.verdict, Verdict::identical);
  EXPECT_EQ(replay.lines, trace.lines.size());
  EXPECT_EQ(replay.events, trace.result.events);
  EXPECT_EQ(replay.discovery_time, trace.result.discovery_time);
  EXPECT_EQ(replay.last_time, trace.result.end_time);
  EXPECT_FALSE(replay.difference);
}

INSTANTIATE_TEST_SUITE_P(Cases, ReplayTest, testing::ValuesIn(trace_cases()), CaseName{});
INSTANTIATE_TEST_SUITE_P(Lives, ReplayTest, testing::Values(Case{"fastdds", living_scenario()}),
                         CaseName{});

TEST(Replay, AMachineThatIsANewOneIsPartOfTheRun) {
  Recording trace = record(living_scenario());
  const auto renewed = std::ranges::find_if(trace.lines, [](const std::string& line) {
    return line.find(R"("event":"Renewed","before":"Complete")") != std::string::npos;
  });
  ASSERT_NE(renewed, trace.lines.end());
  replace(*renewed, R"("event":"Renewed","before":"Complete")",
          R"("event":"Renewed","before":"Recognised")");
  const auto line = static_cast<std::size_t>(renewed - trace.lines.begin()) + 1;
  const Replay replay = Replaying{}(joined(trace.lines));
  ASSERT_TRUE(replay.difference);
  EXPECT_EQ(replay.difference->line, line);
}

TEST(Replay, AChangedValueIsFoundWithItsLineAndKey) {
  Recording trace = record(case_named("hosts2x1x2"));
  replace(trace.lines[40], R"("missing":)", R"("missing":1)");
  const Replay replay = Replaying{}(joined(trace.lines));
  EXPECT_EQ(replay.verdict, Verdict::different);
  EXPECT_EQ(replay.lines, 40U);
  EXPECT_EQ(replay.events, 39U);
  ASSERT_TRUE(replay.difference);
  EXPECT_EQ(replay.difference->line, 41U);
  EXPECT_EQ(replay.difference->mismatch.key, "missing");
  EXPECT_EQ(replay.difference->mismatch.recorded, "1" + replay.difference->mismatch.replayed);
  EXPECT_EQ(replay.difference->recorded_line, trace.lines[40]);
}

TEST(Replay, AChangeInsideATransitionIsFoundWithItsPath) {
  Recording trace = record(case_named("hosts2x1x2"));
  replace(trace.lines[3], R"("after":"Busy")", R"("after":"Idle")");
  const Replay replay = Replaying{}(joined(trace.lines));
  ASSERT_TRUE(replay.difference);
  EXPECT_EQ(replay.difference->line, 4U);
  EXPECT_EQ(replay.difference->mismatch.key, "transitions.0.after");
  EXPECT_EQ(replay.difference->mismatch.recorded, R"("Idle")");
  EXPECT_EQ(replay.difference->mismatch.replayed, R"("Busy")");
}

TEST(Replay, ALineThatIsMissingOrTooManyIsADifference) {
  const Recording trace = record(case_named("hosts2x1x2"));
  std::vector<std::string> lines = trace.lines;
  lines.erase(lines.begin() + 10);
  EXPECT_EQ(Replaying{}(joined(lines)).difference->line, 11U);
  EXPECT_EQ(Replaying{}(joined(lines)).difference->mismatch.key, "n");
  lines = trace.lines;
  lines.insert(lines.begin() + 10, lines[10]);
  EXPECT_EQ(Replaying{}(joined(lines)).difference->line, 12U);
}

TEST(Replay, AChangedScenarioShowsInTheEvents) {
  Recording trace = record(case_named("hosts2x1x2"));
  replace(trace.lines[0], R"("heartbeat_bytes":68)", R"("heartbeat_bytes":69)");
  const Replay replay = Replaying{}(joined(trace.lines));
  EXPECT_EQ(replay.verdict, Verdict::different);
  EXPECT_EQ(replay.difference->mismatch.replayed, "69");
}

TEST(Replay, AHeaderThatIsNotEffectiveIsADifference) {
  Recording trace = record(case_named("hosts2x1x2"));
  replace(trace.lines[0], R"("time_limit":"200s")", R"("time_limit":"200000ms")");
  const Replay replay = Replaying{}(joined(trace.lines));
  ASSERT_TRUE(replay.difference);
  EXPECT_EQ(replay.difference->line, 1U);
  EXPECT_EQ(replay.difference->mismatch.key, "scenario.time_limit");
}

TEST(Replay, AnotherProgramMayHaveWrittenIt) {
  Recording trace = record(case_named("hosts2x1x2"));
  replace(trace.lines[0], R"("program":"stormproof )", R"("program":"stormproof next )");
  const Replay replay = Replaying{}(joined(trace.lines));
  EXPECT_EQ(replay.verdict, Verdict::identical);
  EXPECT_EQ(replay.recorded_by.rfind("stormproof next ", 0), 0U);
}

TEST(Replay, WhiteSpaceAndOrderOfKeysDoNotCount) {
  Recording trace = record(case_named("hosts2x1x2"));
  for (std::string& line : trace.lines) {
    line = nlohmann::json::parse(line).dump(-1) + " \r";  // sorts the keys
  }
  EXPECT_EQ(Replaying{}(joined(trace.lines)).verdict, Verdict::identical);
}

TEST(Replay, TheLastLineFeedMayBeMissing) {
  std::string text = record(case_named("hosts2x1x2")).text;
  text.pop_back();
  EXPECT_EQ(Replaying{}(text).verdict, Verdict::identical);
}

TEST(Replay, ATraceWithoutAnEndAgreesAsFarAsItGoes) {
  Recording trace = record(case_named("hosts2x1x2"));
  const auto time = trace.events[49]["t"].get<std::int64_t>();
  trace.lines.resize(51);
  const Replay replay = Replaying{}(joined(trace.lines));
  EXPECT_EQ(replay.verdict, Verdict::ends_early);
  EXPECT_EQ(replay.events, 50U);
  EXPECT_EQ(replay.last_time, Nanoseconds{time});
  EXPECT_FALSE(replay.discovery_time);
}

TEST(Replay, ATraceOfAnInterruptedRunAgreesAsFarAsItGoes) {
  const Recording trace = record(long_scenario(), [](const Progress&) { return false; });
  const Replay replay = Replaying{}(trace.text);
  EXPECT_EQ(replay.verdict, Verdict::ends_early);
  EXPECT_EQ(replay.lines, trace.lines.size());
  EXPECT_EQ(replay.events, RunOptions::progress_interval);
}

TEST(Replay, AnInterruptedTraceWithAWrongNumberOfEventsDiffers) {
  Recording trace = record(long_scenario(), [](const Progress&) { return false; });
  trace.lines.erase(trace.lines.end() - 2);
  EXPECT_EQ(Replaying{}(joined(trace.lines)).verdict, Verdict::different);
}

TEST(Replay, TheCallerCanStopIt) {
  const config::TestFiles files;
  // Twice as long as what the replay does before it asks.
  const auto enough = [](const Progress& progress) {
    return progress.events < 2 * RunOptions::progress_interval;
  };
  const std::string file = files.write("run.jsonl", record(long_scenario(), enough).text);
  const auto result = replay(file, config::source_specs(), [](const Progress&) { return false; });
  ASSERT_TRUE(result);
  EXPECT_EQ(result->verdict, Verdict::stopped);
  EXPECT_EQ(result->events, RunOptions::progress_interval);
}

}  // namespace replay_test
}  // namespace stormproof::model::trace
