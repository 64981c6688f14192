// The engine: what it finds, counts and shrinks, and that the answer depends on the seed alone.
#include "checker/experiments/fuzz/fuzz.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/experiments/fuzz/variant.hpp"
#include "checker/verification/counterexample/observe.hpp"
#include "checker/verification/counterexample/write.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"
#include "model/trace/replay.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::fuzz {
namespace fuzz_test {

using props::shipped;
using props::VerdictKind;

FuzzReport run(const model::Scenario& scenario, FuzzOptions options) {
  const Ranges ranges = ranges_around(scenario, {});
  return fuzz(scenario, ranges, options);
}

FuzzOptions runs(std::size_t count) {
  FuzzOptions options;
  options.runs = count;
  return options;
}

const Judgment& of(const FuzzReport& report, std::string_view id) {
  const auto found = std::ranges::find(report.judgments, id, &Judgment::id);
  EXPECT_NE(found, report.judgments.end()) << id;
  return *found;
}

std::string json_of(const model::Scenario& scenario, const FuzzReport& report) {
  return to_json(report, {"name", scenario, "command", {}}).dump();
}

/// Four participants on two hosts; a lost packet delays discovery by a HEARTBEAT period, so the
/// limit holds without losses and often breaks with them.
model::Scenario lossy() {
  return shipped("smallest", {"deployment.participants_per_host=2", "limits.completion=150ms",
                              "vary={loss: 0.05, start_jitter: 20ms, timers: 0.1}"});
}

/// The bound of live.recovery is seconds, so what runs half a second has not broken it yet.
TEST(Fuzz, a_run_that_is_too_short_is_no_sample) {
  FuzzOptions options = runs(3);
  options.only = {"live.recovery"};
  const model::Scenario scenario =
      shipped("smallest", {"dds.amendments={}",
                           "deployment.life={outages: [{from: 0, to: 1, start: 0s, end: 499ms}]}",
                           "time_limit=500ms", "vary={start_jitter: 1ms}"});
  const FuzzReport report = run(scenario, options);
  ASSERT_EQ(report.runs.size(), 3U);
  EXPECT_EQ(of(report, "live.recovery").runs, 0U);
  EXPECT_NE(of(report, "live.recovery").verdict, VerdictKind::sampled);
}

TEST(Fuzz, finds_counts_and_bounds_a_planted_violation) {
  const FuzzReport report = run(lossy(), runs(60));
  ASSERT_EQ(report.runs.size(), 60U);
  EXPECT_TRUE(report.violated());
  const Judgment& limit = of(report, "limit.completion");
  EXPECT_EQ(limit.verdict, VerdictKind::violated);
  EXPECT_FALSE(limit.in_base.has_value());
  EXPECT_EQ(limit.runs, 60U);
  std::size_t late = 0;
  for (const JudgedRun& one : report.runs) {
    if (one.discovery_time > model::Nanoseconds{150'000'000}) ++late;
  }
  EXPECT_EQ(limit.broken, late);
  EXPECT_GT(late, 5U);
  EXPECT_LT(late, 55U);
  const double rate = static_cast<double>(late) / 60;
  EXPECT_LT(limit.rate.low, rate);
  EXPECT_GT(limit.rate.high, rate);
  const Judgment& safety = of(report, "safety.snapshot");
  EXPECT_EQ(safety.verdict, VerdictKind::sampled);
  EXPECT_EQ(safety.broken, 0U);
  EXPECT_EQ(safety.runs, 22U);  // it is promised
  EXPECT_NEAR(safety.rate.high, 0.1544, 0.0001);
}

TEST(Fuzz, shrinks_to_a_small_scenario_that_replays) {
  const model::Scenario scenario = lossy();
  const FuzzReport report = run(scenario, runs(20));
  const Judgment& limit = of(report, "limit.completion");
  ASSERT_TRUE(limit.shrunk);
  EXPECT_TRUE(limit.shrunk->finished);
  const props::Counterexample& found = limit.shrunk->counterexample;
  EXPECT_EQ(found.scenario.deployment.size(), 2U);
  EXPECT_LE(found.scenario.wireless.lost_packets.size(), 4U);
  for (std::size_t k = 0; k < found.scenario.wireless.lost_packets.size(); ++k) {
    model::Scenario fewer = found.scenario;  // none of the losses can be done without
    fewer.wireless.lost_packets.erase(fewer.wireless.lost_packets.begin() +
                                      static_cast<std::ptrdiff_t>(k));
    std::uint64_t events = 0;
    EXPECT_FALSE(find_breach(fewer, limit.id, 0, events, {})) << k;
  }
  EXPECT_EQ(found.scenario.dds, scenario.dds);  // the timers are the user's again
  EXPECT_TRUE(model::config::is_valid(found.scenario));
  for (const std::string& line : differences(found.scenario, scenario)) {
    EXPECT_EQ(line.find("dds."), std::string::npos) << line;
  }

  const auto file = std::filesystem::temp_directory_path() / "stormproof-fuzz-test.jsonl";
  {
    std::ofstream out{file};
    const auto wrong = counterexample::write_counterexample(found, out);
    ASSERT_FALSE(wrong) << *wrong;
  }
  const auto replay = model::trace::replay(file.string(), model::config::SpecPath::standard(), {},
                                           counterexample::catalogue_watches());
  ASSERT_TRUE(replay) << to_string(replay.error());
  EXPECT_EQ(replay->verdict, model::trace::Verdict::violated);
  std::filesystem::remove(file);

  const auto read_back = model::config::parse_scenario(
      model::config::effective_yaml(found.scenario), "found", {}, model::config::SpecPath{});
  ASSERT_TRUE(read_back) << to_string(read_back.error());
  EXPECT_EQ(*read_back, found.scenario);
}

/// Lives of Fast DDS are drawn, judged by what the rules say and by recovery, shrunk and replayed.
TEST(Fuzz, draws_lives_of_fastdds) {
  const model::Scenario scenario =
      shipped("rejoin-fastdds",
              {"deployment.life={lease: 20s, outages: [{from: 0, to: 1, start: 1s, end: 2s}]}",
               "run_until=time_limit", "time_limit=60s", "limits.completion=50ms",
               "vary={outages: 2, restarts: 1, late_joiners: 1, failures_within: 10ms}"});
  FuzzOptions options = runs(15);
  options.only = {"composition.followed", "live.recovery", "limit.completion"};
  const FuzzReport report = run(scenario, options);
  ASSERT_EQ(report.runs.size(), 15U);
  EXPECT_EQ(of(report, "composition.followed").verdict, VerdictKind::sampled);
  EXPECT_EQ(of(report, "composition.followed").runs, 15U);
  EXPECT_GT(of(report, "live.recovery").runs, 5U);
  const Judgment& limit = of(report, "limit.completion");
  EXPECT_GT(limit.broken, 3U);
  ASSERT_TRUE(limit.shrunk);
  const props::Counterexample& found = limit.shrunk->counterexample;
  EXPECT_TRUE(found.scenario.deployment.life);
  const auto file = std::filesystem::temp_directory_path() / "stormproof-fuzz-life-test.jsonl";
  {
    std::ofstream out{file};
    const auto wrong = counterexample::write_counterexample(found, out);
    ASSERT_FALSE(wrong) << *wrong;
  }
  const auto replay = model::trace::replay(file.string(), model::config::SpecPath::standard(), {},
                                           counterexample::catalogue_watches());
  std::filesystem::remove(file);
  ASSERT_TRUE(replay) << to_string(replay.error());
  EXPECT_EQ(replay->verdict, model::trace::Verdict::violated);
}

TEST(Fuzz, does_not_depend_on_the_number_of_threads) {
  const model::Scenario scenario = lossy();
  FuzzOptions one = runs(20);
  one.jobs = 1;
  FuzzOptions three = runs(20);
  three.jobs = 3;
  const std::string expected = json_of(scenario, run(scenario, one));
  EXPECT_EQ(json_of(scenario, run(scenario, three)), expected);
  FuzzOptions other = runs(20);
  other.seed = 1;
  EXPECT_NE(json_of(scenario, run(scenario, other)), expected);
}

TEST(Fuzz, a_run_can_be_repeated_alone) {
  const FuzzReport all = run(lossy(), runs(12));
  FuzzOptions single = runs(1);
  single.first = 9;
  const FuzzReport alone = run(lossy(), single);
  ASSERT_EQ(alone.runs.size(), 1U);
  EXPECT_EQ(alone.runs[0].number, 9U);
  EXPECT_EQ(alone.runs[0].discovery_time, all.runs[9].discovery_time);
  EXPECT_EQ(alone.runs[0].events, all.runs[9].events);
  EXPECT_EQ(alone.runs[0].lost, all.runs[9].lost);
}

TEST(Fuzz, what_breaks_without_variation_hides_nothing) {
  const model::Scenario scenario = shipped("smallest", {"limits.messages=90", "vary.loss=0.05"});
  const FuzzReport report = run(scenario, runs(20));
  const Judgment& threshold = of(report, "storm.free-threshold");
  EXPECT_TRUE(threshold.in_base.has_value());
  EXPECT_FALSE(threshold.sampled);
  EXPECT_EQ(threshold.verdict, VerdictKind::violated);
  EXPECT_EQ(threshold.runs, 0U);
  const Judgment& limit = of(report, "limit.messages");  // a limit is always counted
  EXPECT_TRUE(limit.in_base.has_value());
  EXPECT_TRUE(limit.sampled);
  EXPECT_GT(limit.broken, 0U);
  EXPECT_EQ(of(report, "safety.conservation").runs, 20U);
}

/// Limits judge every run, also those in which nobody watches what is promised.
TEST(Fuzz, watches_what_is_promised_in_some_runs) {
  const FuzzReport report = run(lossy(), runs(45));
  ASSERT_EQ(report.runs.size(), 45U);
  std::size_t promised = 0;
  for (const Judgment& judgment : report.judgments) {
    if (!judgment.sampled) continue;
    if (judgment.promised) ++promised;
    // Runs 0 to 19, 20 and 40.
    EXPECT_EQ(judgment.runs, judgment.promised ? 22U : 45U) << judgment.id;
  }
  EXPECT_GT(promised, 5U);
  EXPECT_TRUE(of(report, "composition.followed").promised);
  EXPECT_FALSE(of(report, "limit.completion").promised);
  FuzzOptions named = runs(45);
  named.only = {"composition.followed"};
  EXPECT_EQ(of(run(lossy(), named), "composition.followed").runs, 45U);
}

/// What a run is like does not depend on who watches it.
TEST(Fuzz, unwatched_runs_are_the_same) {
  FuzzOptions tail = runs(5);
  tail.first = 25;
  const FuzzReport all = run(lossy(), runs(30));
  const FuzzReport watched = run(lossy(), tail);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(all.runs[25 + k].events, watched.runs[k].events);
    EXPECT_EQ(all.runs[25 + k].discovery_time, watched.runs[k].discovery_time);
    EXPECT_EQ(all.runs[25 + k].lost, watched.runs[k].lost);
  }
}

TEST(Fuzz, judges_by_what_was_asked_for) {
  FuzzOptions options = runs(3);
  options.only = {"storm.free-threshold", "live.quiescence"};
  const FuzzReport report = run(lossy(), options);
  ASSERT_EQ(report.judgments.size(), 2U);
  EXPECT_TRUE(of(report, "storm.free-threshold").sampled);
  EXPECT_EQ(of(report, "live.quiescence").verdict, VerdictKind::sampled);
  EXPECT_EQ(of(report, "live.quiescence").runs, 3U);
}

TEST(Fuzz, losses_have_no_last_packet) {
  // Everything is lost from the start: the run emits many more packets than the unperturbed one.
  const model::Scenario scenario = shipped("smallest", {"vary.loss=1", "time_limit=60s"});
  FuzzOptions options = runs(1);
  options.only = {"safety.conservation"};
  const FuzzReport report = run(scenario, options);
  ASSERT_EQ(report.runs.size(), 1U);
  EXPECT_EQ(report.incomplete, 1U);
  EXPECT_FALSE(report.completion_ns.median.has_value());
  EXPECT_EQ(report.runs[0].lost, report.runs[0].packets);
}

TEST(Fuzz, a_run_loses_what_was_drawn_for_it_and_no_more) {
  const model::Scenario base = shipped("smallest");
  const auto losses = [](std::uint64_t packets) {
    std::vector<std::uint64_t> lost;
    for (std::uint64_t k = 3; k < packets; k += 10) lost.push_back(k);
    return lost;
  };
  model::Scenario few = base;
  model::Scenario many = base;
  const auto a = run_and_judge(few, {}, losses, 1, {});
  const auto b = run_and_judge(many, {}, losses, 100'000, {});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->packets, b->packets);
  EXPECT_EQ(few, many);
  EXPECT_EQ(few.wireless.lost_packets, losses(a->packets));
  EXPECT_EQ(a->discovery_time, model::simulate(few).discovery_time);
}

TEST(Fuzz, stops_when_it_is_told_to) {
  FuzzOptions options = runs(1'000'000);
  options.jobs = 2;
  options.on_progress = [](const FuzzProgress& progress) { return progress.finished < 10; };
  const FuzzReport report = run(lossy(), options);
  EXPECT_TRUE(report.interrupted);
  EXPECT_GE(report.runs.size(), 8U);
  EXPECT_LE(report.runs.size(), 12U);
  EXPECT_EQ(of(report, "safety.snapshot").runs, report.runs.size());
}

TEST(Fuzz, an_early_stop_leaves_nothing_known) {
  FuzzOptions options = runs(10);
  options.on_progress = [](const FuzzProgress&) { return false; };
  const FuzzReport report = run(lossy(), options);
  EXPECT_TRUE(report.runs.empty());
  EXPECT_FALSE(report.violated());
  EXPECT_EQ(of(report, "safety.snapshot").verdict, VerdictKind::inconclusive);
}

TEST(Fuzz, says_when_the_ranges_hold_no_valid_scenario) {
  const model::Scenario scenario = shipped("smallest");
  const Ranges ranges = ranges_around(
      scenario, {*parse_knob_range("dds.sedp.shared_header_bytes=2000..3000", scenario)});
  const FuzzReport report = fuzz(scenario, ranges, runs(5));
  EXPECT_TRUE(report.undrawable);
  EXPECT_TRUE(report.runs.empty());
}

}  // namespace fuzz_test
}  // namespace stormproof::fuzz
