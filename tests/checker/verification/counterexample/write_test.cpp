// Counterexamples as files, and their replay: the round trip, and everything that can be wrong.
#include "checker/verification/counterexample/write.hpp"

#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/verification/counterexample/observe.hpp"
#include "tests/checker/verification/counterexample/examples.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::counterexample {
namespace write_test {

using model::config::Result;
using model::trace::Replay;
using model::trace::Verdict;
using nlohmann::ordered_json;

std::vector<std::string> lines_of(const props::Counterexample& counterexample) {
  std::ostringstream out;
  EXPECT_EQ(write_counterexample(counterexample, out), std::nullopt);
  std::istringstream in{out.str()};
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

class Replaying {
 public:
  Result<Replay> operator()(const std::vector<std::string>& lines) const {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return replay(files_.write("run.jsonl", text));
  }
  Result<Replay> replay(const std::string& file) const {
    return model::trace::replay(file, model::config::source_specs(), {}, catalogue_watches());
  }
  [[nodiscard]] std::string file() const { return files_.path("run.jsonl"); }

 private:
  model::config::TestFiles files_;
};

/// Changes the header, the last line, or both.
std::string changed(const std::string& line, const std::string& pointer,
                    const ordered_json& value) {
  ordered_json json = ordered_json::parse(line);
  json[ordered_json::json_pointer{pointer}] = value;
  return json.dump();
}

TEST(WriteCounterexample, HeaderEventsAndViolation) {
  const props::Counterexample example = smallest();
  const auto lines = lines_of(example);
  ASSERT_EQ(lines.size(), example.event + 3);
  const auto expect = ordered_json::parse(lines.front())["expect"];
  EXPECT_EQ(expect["property"], "storm.free-threshold");
  EXPECT_EQ(expect["event"], 101);
  EXPECT_EQ(expect["t"], 13'653'072);
  EXPECT_EQ(expect["reason"], example.reason);
  EXPECT_EQ(ordered_json::parse(lines[lines.size() - 2])["n"], 101);
  EXPECT_EQ(ordered_json::parse(lines.back()), (ordered_json{{"violation", expect}}));
}

TEST(WriteCounterexample, AnEventThatIsNotTheViolationIsRefused) {
  props::Counterexample wrong = smallest();
  wrong.event = 100;
  std::ostringstream out;
  EXPECT_EQ(write_counterexample(wrong, out),
            "storm.free-threshold: the run violates it at event 101, not at event 100");
  EXPECT_EQ(out.str(), "");
}

TEST(WriteCounterexample, ARunThatKeepsThePropertyIsRefused) {
  props::Counterexample wrong = smallest();
  wrong.property = "safety.conservation";
  std::ostringstream out;
  EXPECT_EQ(write_counterexample(wrong, out),
            "safety.conservation: the run of the counterexample does not violate it");
  wrong.property = "fsm.determinism";
  EXPECT_EQ(write_counterexample(wrong, out),
            "fsm.determinism: no monitor can observe it in a run");
  EXPECT_EQ(out.str(), "");
}

TEST(WriteCounterexample, TheCallersMonitorDecides) {
  FirstRepair monitor;
  std::ostringstream out;
  EXPECT_EQ(write_counterexample(lossy(), monitor, out), std::nullopt);
  EXPECT_NE(out.str().find("The first repair is sent."), std::string::npos);
}

class RoundTrip : public testing::TestWithParam<std::size_t> {};

TEST_P(RoundTrip, TheViolationOccursAgain) {
  const props::Counterexample& example = examples()[GetParam()].counterexample;
  const Replaying replaying;
  const auto lines = lines_of(example);
  const auto replay = replaying(lines);
  ASSERT_TRUE(replay) << to_string(replay.error());
  EXPECT_EQ(replay->verdict, Verdict::violated);
  EXPECT_EQ(replay->events, example.event + 1);
  EXPECT_EQ(replay->lines, lines.size());
  ASSERT_TRUE(replay->violation);
  EXPECT_EQ(replay->violation->event, example.event);
  EXPECT_EQ(replay->violation->reason, example.reason);
  EXPECT_EQ(replay->expected->property, example.property);
}

// Without the one whose monitor is not in the catalogue.
INSTANTIATE_TEST_SUITE_P(Examples, RoundTrip, testing::Values(0, 1, 3, 4, 5),
                         [](const auto& chosen) {
                           return std::string{example_names[chosen.param]};
                         });

class ReplayCounterexample : public testing::Test {
 protected:
  Replay replayed() {
    const auto result = replaying_(lines_);
    EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
    return result ? *result : Replay{};
  }
  std::string error() {
    const auto result = replaying_(lines_);
    return result ? "no error" : to_string(result.error());
  }
  void change(std::size_t line, const std::string& pointer, const ordered_json& value) {
    lines_[line] = changed(lines_[line], pointer, value);
  }

  std::vector<std::string> lines_ = lines_of(smallest());
  Replaying replaying_;
};

TEST_F(ReplayCounterexample, AChangedEventIsNoEvidence) {
  change(50, "/t", 7);
  const Replay replay = replayed();
  EXPECT_EQ(replay.verdict, Verdict::different);
  EXPECT_EQ(replay.difference->line, 51U);
  EXPECT_EQ(replay.difference->mismatch.key, "t");
  EXPECT_TRUE(replay.expected);
}

TEST_F(ReplayCounterexample, AnExpectationTooEarlyDoesNotOccur) {
  change(0, "/expect/event", 90);
  const Replay replay = replayed();
  EXPECT_EQ(replay.verdict, Verdict::not_violated);
  EXPECT_EQ(replay.events, 91U);
  ASSERT_TRUE(replay.violation);
  EXPECT_EQ(replay.violation->event, 101U);
}

TEST_F(ReplayCounterexample, AnExpectationTooLateMeetsTheViolationFirst) {
  change(0, "/expect/event", 110);
  const Replay replay = replayed();
  EXPECT_EQ(replay.verdict, Verdict::different);
  EXPECT_EQ(replay.difference->line, 104U);
}

TEST_F(ReplayCounterexample, AnotherTimeDoesNotOccur) {
  change(0, "/expect/t", 1);
  EXPECT_EQ(replayed().verdict, Verdict::not_violated);
}

TEST_F(ReplayCounterexample, AnotherPropertyDoesNotBreak) {
  change(0, "/expect/property", "safety.conservation");
  const Replay replay = replayed();
  EXPECT_EQ(replay.verdict, Verdict::not_violated);
  EXPECT_FALSE(replay.violation);
}

TEST_F(ReplayCounterexample, AnotherScenarioHasOtherEvents) {
  change(0, "/scenario/wireless/overhead_unicast", "200us");
  EXPECT_EQ(replayed().verdict, Verdict::different);
}

TEST_F(ReplayCounterexample, TheReasonMayBeWordedOtherwise) {
  change(0, "/expect/reason", "In other words.");
  change(lines_.size() - 1, "/violation/reason", "In other words.");
  const Replay replay = replayed();
  EXPECT_EQ(replay.verdict, Verdict::violated);
  EXPECT_EQ(replay.violation->reason, smallest().reason);
}

TEST_F(ReplayCounterexample, AChangedLastLineIsADifference) {
  change(lines_.size() - 1, "/violation/event", 7);
  const Replay replay = replayed();
  EXPECT_EQ(replay.verdict, Verdict::different);
  EXPECT_EQ(replay.difference->mismatch.key, "violation.event");
  EXPECT_EQ(replay.difference->mismatch.replayed, "101");
}

TEST_F(ReplayCounterexample, WithoutItsEndItIsIncomplete) {
  lines_.pop_back();
  EXPECT_EQ(replayed().verdict, Verdict::ends_early);
  lines_.resize(60);
  EXPECT_EQ(replayed().verdict, Verdict::ends_early);
}

TEST_F(ReplayCounterexample, AfterTheViolationNothingFollows) {
  lines_.emplace_back("{}");
  EXPECT_EQ(error(), replaying_.file() +
                         ":105: a line after the last line of the trace; expected the end of the "
                         "file");
}

TEST_F(ReplayCounterexample, ALastLineThatIsNotJsonIsAnError) {
  lines_.back() = "violated, believe me";
  EXPECT_EQ(error(), replaying_.file() + ":104: not a JSON object; expected the violation");
}

TEST_F(ReplayCounterexample, AnUnknownPropertyIsAnError) {
  change(0, "/expect/property", "safety.snapshots");
  EXPECT_EQ(error(), replaying_.file() +
                         ":1: 'expect.property' is 'safety.snapshots'; expected a property that a "
                         "replay can observe");
}

TEST_F(ReplayCounterexample, WrongTypesAreErrors) {
  const std::string place = replaying_.file() + ":1: ";
  const std::string header = lines_[0];
  change(0, "/expect", 5);
  EXPECT_EQ(error(), place + "'expect' is 5; expected an object with the violation");
  lines_[0] = changed(header, "/expect/event", "101");
  EXPECT_EQ(error(), place + "'expect.event' is \"101\"; expected a natural number");
  lines_[0] = changed(header, "/expect/t", -1);
  EXPECT_EQ(error(), place + "'expect.t' is -1; expected a natural number");
  lines_[0] = changed(header, "/expect/t", 1.5);
  EXPECT_EQ(error(), place + "'expect.t' is 1.5; expected a natural number");
  lines_[0] = changed(header, "/expect/event", UINT64_MAX);
  EXPECT_EQ(error(), place + "'expect.event' is 18446744073709551615; expected a natural number");
  lines_[0] = changed(header, "/expect/property", nullptr);
  EXPECT_EQ(error(), place + "'expect.property' is null; expected a text");
  lines_[0] = changed(header, "/expect", ordered_json::object());
  EXPECT_EQ(error(), place + "'expect.property' is null; expected a text");
}

TEST_F(ReplayCounterexample, WithoutWatchesItCannotBeJudged) {
  EXPECT_EQ(replayed().verdict, Verdict::violated);
  const auto result = model::trace::replay(replaying_.file(), model::config::source_specs());
  ASSERT_FALSE(result);
  EXPECT_NE(to_string(result.error()).find("expected a property"), std::string::npos);
}

TEST_F(ReplayCounterexample, WithoutExpectItIsAnInterruptedTrace) {
  ordered_json header = ordered_json::parse(lines_[0]);
  header.erase("expect");
  lines_[0] = header.dump();
  lines_.pop_back();
  const Replay replay = replayed();
  EXPECT_EQ(replay.verdict, Verdict::ends_early);
  EXPECT_FALSE(replay.expected);
  EXPECT_FALSE(replay.violation);
}

TEST(Observe, ObjectsInARunAndAfterIt) {
  FirstRepair monitor;
  const auto found = observe(scenario_named("smallest"), monitor);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->event, 101U);
  FirstRepair silent;
  EXPECT_FALSE(
      observe(scenario_named("smallest", {"wireless.kind=constant_delay", "wireless.one_way=30us"}),
              silent));
}

}  // namespace write_test
}  // namespace stormproof::counterexample
