// Whole studies whose effects are known by hand, and their reports.
#include <algorithm>
#include <atomic>
#include <limits>

#include <nlohmann/json.hpp>

#include "checker/experiments/sensitivity/sensitivity.hpp"
#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "tests/checker/experiments/sensitivity/scenarios.hpp"

namespace stormproof::sensitivity {
namespace study_test {

const KnobResult& knob_in(const Report& report, const std::string& key) {
  const auto found = std::ranges::find(report.knobs, key, &KnobResult::key);
  if (found != report.knobs.end()) return *found;
  ADD_FAILURE() << "no knob " << key;
  static const KnobResult none;
  return none;
}

Effect effect(const Report& report, const std::string& key, Direction direction,
              Measure measure = Measure::completion) {
  const auto& level = knob_in(report, key).levels[static_cast<std::size_t>(direction)];
  if (level) return of(level->effects, measure);
  ADD_FAILURE() << key << " has no such level";
  return {};
}

std::size_t position(const Report& report, const std::string& key) {
  const auto found = std::ranges::find(report.knobs, key, &KnobResult::key);
  return static_cast<std::size_t>(found - report.knobs.begin());
}

/// A delay of 100 µs: announcements take one, the descriptors that they cause take another.
model::Scenario wired() { return scenario_with({"wireless=wired"}); }

TEST(SensitivityStudy, OneWayDelayCountsTwice) {
  const Report report = analyse(wired(), {});
  EXPECT_EQ(report.base[0], 200'000);
  EXPECT_EQ(effect(report, "wireless.one_way", Direction::down).median, -40'000);
  EXPECT_EQ(effect(report, "wireless.one_way", Direction::up).median, 40'000);
  EXPECT_EQ(report.knobs.front().key, "wireless.one_way");
  EXPECT_TRUE(effect(report, "wireless.one_way", Direction::up, Measure::messages).exactly_zero);
}

TEST(SensitivityStudy, AHalfIsAHalf) {
  Options options;
  options.range = 0.5;
  const Report report = analyse(wired(), options);
  EXPECT_EQ(effect(report, "wireless.one_way", Direction::down).median, -100'000);
}

TEST(SensitivityStudy, OneMorePublicationIsOneMoreDescriptorForEachReader) {
  const Report report = analyse(scenario_with({"wireless=wired", "dds.sedp.piggyback=off"}), {});
  // 9 ± 2 default publications in both directions.
  const Effect up =
      effect(report, "dds.descriptors.default_publications", Direction::up, Measure::messages);
  EXPECT_EQ(up.median, 4);
}

TEST(SensitivityStudy, KnobsOfThePolicyThatIsNotUsedComeLast) {
  const Report report = analyse(scenario_with({}), {});
  for (const char* key : {"dds.sedp.adaptive.min_period", "dds.sedp.adaptive.max_period"}) {
    EXPECT_TRUE(knob_in(report, key).is_without_effect(Measure::completion));
    EXPECT_TRUE(knob_in(report, key).is_without_effect(Measure::messages));
    EXPECT_GT(position(report, key), position(report, "wireless.overhead_unicast"));
  }
  EXPECT_FALSE(knob_in(report, "wireless.overhead_unicast").is_without_effect(Measure::completion));
}

/// Nobody hears the other for longer than its lease, and for less than a longer one; who was
/// forgotten is learned again from its next announcement.
TEST(SensitivityStudy, RanksLeasesAndAnnouncementPeriods) {
  const model::Scenario scenario = scenario_with(
      {"wireless=wired", "dds=paper", "dds.amendments={}", "dds.spdp.period=3s", "time_limit=60s",
       "deployment.life={lease: 10s, outages: [{from: 1, to: 0, start: 5s, end: 14s}, "
       "{from: 0, to: 1, start: 5s, end: 14s}]}"});
  const Report report = analyse(scenario, {});
  for (const char* key : {"dds.spdp.period", "deployment.life.lease"}) {
    EXPECT_FALSE(knob_in(report, key).is_without_effect(Measure::completion)) << key;
    EXPECT_LT(position(report, key), position(report, "dds.sedp.adaptive.min_period")) << key;
  }
  EXPECT_LT(effect(report, "deployment.life.lease", Direction::up).median, -1'000'000'000);
}

TEST(SensitivityStudy, RanksByTheMeasureThatIsAskedFor) {
  Options options;
  options.by = Measure::messages;
  const Report report = analyse(scenario_with({}), options);
  for (std::size_t k = 1; k < report.knobs.size(); ++k) {
    EXPECT_GE(report.knobs[k - 1].swing(Measure::messages),
              report.knobs[k].swing(Measure::messages));
  }
  EXPECT_GT(position(report, "wireless.overhead_unicast"),
            position(report, "deployment.endpoints"));
}

Options jittered() {
  Options options;
  options.samples = 7;
  options.first_seed = 11;
  options.start_jitter = model::Nanoseconds{5'000'000};
  options.pairs_of = 3;
  return options;
}

Description description_of(const Options& options) {
  Description description;
  description.scenario = "test";
  description.options = options;
  return description;
}

TEST(SensitivityStudy, IsTheSameOnAnyNumberOfThreads) {
  Options one = jittered();
  one.threads = 1;
  Options three = jittered();
  three.threads = 3;
  const model::Scenario scenario = scenario_with({});
  const std::string first = to_json(analyse(scenario, one), description_of(one)).dump();
  EXPECT_EQ(first, to_json(analyse(scenario, three), description_of(three)).dump());
  Options other_seed = jittered();
  other_seed.first_seed = 12;
  EXPECT_NE(first, to_json(analyse(scenario, other_seed), description_of(one)).dump());
}

TEST(SensitivityStudy, PairsOfIndependentDelaysJustAddUp) {
  // The first knob is one_way, the second one changes nothing.
  const model::Scenario scenario =
      scenario_with({"wireless=wired", "dds.sedp.initial_acknack_delay=0"});
  Options options;
  options.pairs_of = 2;
  const Report report = analyse(scenario, options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(of(report.pairs[0].interaction, Measure::completion).median, 0);
  EXPECT_EQ(of(report.pairs[0].joint, Measure::completion).median, 40'000);
}

TEST(SensitivityStudy, ParticipantsAndEndpointsMultiply) {
  const model::Scenario scenario =
      scenario_with({"wireless=wired", "deployment.endpoints_per_participant=100"});
  Options options;
  options.pairs_of = 2;
  options.by = Measure::messages;
  const Report report = analyse(scenario, options);
  ASSERT_EQ(report.pairs.size(), 1U);
  EXPECT_EQ(report.pairs[0].keys[0], "deployment.participants");
  EXPECT_GT(of(report.pairs[0].interaction, Measure::messages).median, 0);
}

TEST(SensitivityStudy, ChangeThatKeepsDiscoveryFromCompletingIsInfinite) {
  model::Scenario scenario = wired();
  scenario.time_limit = model::Nanoseconds{210'000};
  const Report report = analyse(scenario, {});
  const Effect later = effect(report, "wireless.one_way", Direction::up);
  EXPECT_EQ(later.median, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(later.is_clear());
  const auto& level = knob_in(report, "wireless.one_way").levels[1];
  ASSERT_TRUE(level);
  EXPECT_EQ(level->incomplete, 1U);
  EXPECT_EQ(effect(report, "wireless.one_way", Direction::down).median, -40'000);
  // It is no time, so JSON has none, and text says so.
  const auto json = nlohmann::ordered_json::parse(to_json(report, description_of({})).dump());
  for (const auto& knob : json["knobs"]) {
    if (knob["key"] != "wireless.one_way") continue;
    EXPECT_TRUE(knob["levels"][1]["t_disc_ns"]["estimate"].is_null());
  }
  EXPECT_NE(report::to_text(document_of(report, description_of({}))).find("+∞"), std::string::npos);
}

TEST(SensitivityStudy, StoppedStudiesSaySo) {
  Options options;
  options.threads = 1;
  options.on_progress = [](std::size_t finished, std::size_t) { return finished < 8; };
  const Report report = analyse(wired(), options);
  EXPECT_FALSE(report.finished);
  EXPECT_EQ(report.runs, 8U);
  EXPECT_FALSE(report.knobs.empty());
  EXPECT_LT(report.knobs.size(), analyse(wired(), {}).knobs.size());
  EXPECT_NE(report::to_text(document_of(report, description_of(options))).find("interrupted"),
            std::string::npos);
}

TEST(SensitivityStudy, StoppedSamplesAreFewerSamples) {
  Options options = jittered();
  options.threads = 1;
  std::size_t in_each = 0;
  options.on_progress = [&in_each](std::size_t finished, std::size_t runs) {
    in_each = runs / 7;
    return finished < 3 * in_each + 5;
  };
  const Report report = analyse(wired(), options);
  EXPECT_FALSE(report.finished);
  EXPECT_EQ(report.samples, 3U);
  Options three = jittered();
  three.samples = 3;
  three.pairs_of = 0;
  const Report whole = analyse(wired(), three);
  ASSERT_EQ(report.knobs.size(), whole.knobs.size());
  for (const Direction direction : directions) {
    EXPECT_EQ(effect(report, "wireless.one_way", direction),
              effect(whole, "wireless.one_way", direction));
  }
}

/// What does not complete is cut for all if there is no time; what completes is not.
TEST(SensitivityStudy, WhatThereIsNoTimeForIsCutAndSaid) {
  Options options = jittered();
  options.samples = 40;
  options.time = trials::Budget{[] { return std::optional{0.0}; }};
  const Report whole = analyse(wired(), options);
  EXPECT_TRUE(whole.unasked.lacked_time());
  EXPECT_EQ(whole.samples, 6U);
  EXPECT_TRUE(whole.pairs.empty());
  EXPECT_FALSE(whole.cut_at);
  const model::Scenario endless =
      scenario_with({"wireless=wired", "wireless.one_way=30s", "time_limit=20s"});
  const Report cut = analyse(endless, options);
  ASSERT_TRUE(cut.cut_at);
  EXPECT_LT(*cut.cut_at, endless.time_limit);
  EXPECT_EQ(cut.incomplete, cut.samples);
  const nlohmann::ordered_json json = to_json(cut, description_of(options));
  EXPECT_EQ(json["fitted_into_time"], true);
  EXPECT_EQ(json["cut_at_ns"], cut.cut_at->count());
  const std::string text = report::to_text(document_of(cut, description_of(options)));
  EXPECT_NE(text.find("to keep to --time"), std::string::npos) << text;
  EXPECT_NE(text.find("6 of 40 runs of each change"), std::string::npos) << text;
  ASSERT_EQ(cut.unasked.cuts.size(), 1U);
  EXPECT_EQ(cut.unasked.cuts.front().runs + 2, cut.runs) << "all but the two that it is planned by";
  EXPECT_NE(text.find("they take at least that long"), std::string::npos) << text;
  options.time = trials::Budget{[] { return std::optional{1e9}; }};
  options.samples = 2;
  EXPECT_FALSE(analyse(endless, options).unasked.lacked_time());
}

TEST(SensitivityStudy, NothingIsKnownWithoutTheUnchangedRun) {
  Options options;
  options.on_progress = [](std::size_t, std::size_t) { return false; };
  options.samples = 3;
  options.threads = 1;
  options.start_jitter = model::Nanoseconds{1'000};
  const Report report = analyse(wired(), options);
  EXPECT_TRUE(report.knobs.empty());
  EXPECT_NE(report::to_text(document_of(report, description_of(options)))
                .find("Interrupted before any change"),
            std::string::npos);
}

TEST(SensitivityReport, TextWarnsOfSingleTrajectories) {
  const Report report = analyse(wired(), {});
  const std::string text = report::to_text(document_of(report, description_of({})));
  EXPECT_NE(text.find("wireless.one_way"), std::string::npos);
  EXPECT_NE(text.find("+40.00 µs"), std::string::npos) << text;
  EXPECT_NE(text.find("each change is one trajectory"), std::string::npos);
  const Options options = jittered();
  const std::string sampled =
      report::to_text(document_of(analyse(wired(), options), description_of(options)));
  EXPECT_EQ(sampled.find("each change is one trajectory"), std::string::npos);
  EXPECT_NE(sampled.find("98.4 %"), std::string::npos) << sampled;
}

TEST(SensitivityReport, JsonRanksBothMeasures) {
  const auto json = to_json(analyse(wired(), {}), description_of({}));
  const auto& first = json["knobs"][0];
  EXPECT_EQ(first["key"], "wireless.one_way");
  EXPECT_EQ(first["rank_completion"], 1);
  EXPECT_GT(first["rank_messages"], 1);
  EXPECT_EQ(first["levels"][0]["t_disc_ns"]["estimate"], -40'000);
  EXPECT_EQ(json["base"]["t_disc_ns"], 200'000);
}

TEST(SensitivityReport, PlotHasTheKnobsWithAnEffect) {
  const std::string svg = to_svg(analyse(wired(), {}), description_of({}));
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
  EXPECT_NE(svg.find("wireless.one_way"), std::string::npos);
  EXPECT_EQ(svg.find("adaptive.min_period"), std::string::npos);
}

}  // namespace study_test
}  // namespace stormproof::sensitivity
