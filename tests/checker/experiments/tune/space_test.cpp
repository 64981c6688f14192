// What may be searched, its scales, and which library a scenario's profile is.
#include "checker/experiments/tune/space.hpp"

#include <gtest/gtest.h>

#include "checker/experiments/tune/deploy.hpp"
#include "checker/experiments/tune/subject.hpp"

namespace stormproof::tune {
namespace space_test {

using model::config::NumericKnob;
namespace vendor = model::config::vendor;

const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

model::config::Result<Subject> subject_of(std::vector<std::string> changes,
                                          const std::string& preset = {}) {
  return read_subject("smallest", changes, preset, specs);
}

Dimension bytes(std::int64_t minimum, std::int64_t maximum) {
  Dimension dimension;
  dimension.unit = NumericKnob::Unit::bytes;
  dimension.minimum = minimum;
  dimension.maximum = maximum;
  return dimension;
}

TEST(TuneSpace, WideRangesAreSearchedInFactors) {
  EXPECT_EQ(bytes(100, 1'000'000).value_at(0.5), 10'000);
  EXPECT_EQ(bytes(100, 900).value_at(0.5), 500);
  EXPECT_EQ(bytes(0, 1'000'000).value_at(0), 0);
  EXPECT_EQ(bytes(0, 1'000'000).value_at(0.5), 1'000);
}

TEST(TuneSpace, ValuesHaveTwoDigitsAndStayInside) {
  const Dimension dimension = bytes(65'507, 67'108'864);
  for (int k = 0; k <= 100; ++k) {
    const std::int64_t value = dimension.value_at(k / 100.0);
    EXPECT_GE(value, dimension.minimum);
    EXPECT_LE(value, dimension.maximum);
    std::int64_t digits = value;
    while (digits % 10 == 0) digits /= 10;
    const bool is_end = value == dimension.minimum || value == dimension.maximum;
    EXPECT_TRUE(is_end || digits < 100) << value;
    EXPECT_NEAR(dimension.position_of(value), k / 100.0, 0.01);
  }
  EXPECT_EQ(dimension.position_of(1), 0);
  EXPECT_EQ(dimension.position_of(1'000'000'000), 1);
}

TEST(TuneSpace, SearchesWhatAUserCanSet) {
  const auto subject = subject_of({"dds=fastdds-2.6.11"});
  ASSERT_TRUE(subject) << to_string(subject.error());
  const Space space = space_of(subject->scenario, vendor::vendor_knobs(subject->vendor));
  EXPECT_TRUE(space.find("dds.spdp.period"));
  EXPECT_TRUE(space.find("dds.sedp.piggyback_threshold_bytes"));
  EXPECT_FALSE(space.find("dds.sedp.heartbeat_period")) << "a constant of the library";
  for (const Dimension& dimension : space.dimensions) {
    EXPECT_FALSE(dimension.setting.empty());
    EXPECT_LT(dimension.minimum, dimension.maximum);
  }
  EXPECT_FALSE(space.fixed.empty());
}

TEST(TuneSpace, SearchesSwitches) {
  const auto subject = subject_of({"dds=fastdds-3.6"});
  ASSERT_TRUE(subject) << to_string(subject.error());
  const Space space = space_of(subject->scenario, vendor::vendor_knobs(subject->vendor));
  const auto found = space.find("dds.type_lookup");
  ASSERT_TRUE(found);
  const Dimension& lookup = space.dimensions[*found];
  EXPECT_EQ(lookup.print(lookup.unchanged), "true");
  EXPECT_EQ(lookup.print(lookup.value_at(0)), "false");
  Point point = space.unchanged();
  EXPECT_EQ(space.apply(subject->scenario, point), subject->scenario);
  point[*found] = 0;
  const model::Scenario changed = space.apply(subject->scenario, point);
  EXPECT_EQ(changed.dds.version.type_lookup, model::Whether::no);
  model::Scenario only_that = changed;
  only_that.dds.version.type_lookup = model::Whether::yes;
  EXPECT_EQ(only_that, subject->scenario);
  EXPECT_FALSE(space.find("dds.discovery")) << "a word among many";
  const auto earlier = subject_of({"dds=fastdds-2.6.11"});
  ASSERT_TRUE(earlier);
  EXPECT_FALSE(
      space_of(earlier->scenario, vendor::vendor_knobs(earlier->vendor)).find("dds.type_lookup"))
      << "2.6 has no such property";
}

TEST(TuneSpace, AppliesAndTellsChanges) {
  const auto subject = subject_of({"dds=fastdds-2.6.11"});
  ASSERT_TRUE(subject);
  const Space space = space_of(subject->scenario, vendor::vendor_knobs(subject->vendor));
  Point point = space.unchanged();
  EXPECT_EQ(space.apply(subject->scenario, point), subject->scenario);
  EXPECT_TRUE(space.changes(point).empty());
  const std::size_t d = *space.find("dds.sedp.piggyback_threshold_bytes");
  point[d] = 4'000'000;
  EXPECT_EQ(space.changes(point), std::vector<std::size_t>{d});
  const model::Scenario changed = space.apply(subject->scenario, point);
  EXPECT_EQ(changed.dds.sedp.piggyback_threshold_bytes, model::Bytes{4'000'000});
}

TEST(TuneSubject, KnowsThePresetThroughBasesAndOverrides) {
  EXPECT_EQ(subject_of({"dds=fastdds-2.6.11"})->preset, "fastdds-2.6.11");
  EXPECT_EQ(subject_of({"dds=fastdds-2.14.5"})->preset, "fastdds-2.14.5");
  EXPECT_EQ(subject_of({"dds={base: fastdds-3.2, spdp: {period: 1s}}"})->preset, "fastdds-3.2");
  EXPECT_EQ(subject_of({}, "fastdds-2.6.11")->preset, "fastdds-2.6.11");
}

/// Settings of a user in a shipped profile are settings, not part of the version.
TEST(TuneSubject, SettingsAreNoPartOfTheVersion) {
  const auto subject = subject_of({"dds=fastdds-2.6.11-sndbuf4M"});
  ASSERT_TRUE(subject);
  EXPECT_EQ(subject->preset, "fastdds-2.6.11");
  const auto xml = deployable(*subject, subject->scenario.dds, "", specs);
  ASSERT_TRUE(xml) << to_string(xml.error());
  EXPECT_NE(xml->find("<sendBufferSize>4000000</sendBufferSize>"), std::string::npos);
}

TEST(TuneSubject, RefusesWhatIsNoProduct) {
  const auto paper = subject_of({"dds=paper"});
  ASSERT_FALSE(paper);
  EXPECT_NE(paper.error().message.find("fastdds-2.6.11"), std::string::npos)
      << "names what can be tuned";
  EXPECT_FALSE(subject_of({"dds=fastdds-2.6.11-relations"})) << "the paper's writer";
  EXPECT_FALSE(subject_of({}, "fastdds-99"));
}

TEST(TuneDeploy, NoFileForWhatNobodyCanSet) {
  const auto subject = subject_of({"dds=fastdds-2.6.11", "dds.sedp.heartbeat_period=2s"});
  ASSERT_TRUE(subject);
  EXPECT_FALSE(deployable(*subject, subject->scenario.dds, "", specs));
}

TEST(TuneDeploy, ReadsBackWhatItWrites) {
  const auto subject = subject_of({"dds=fastdds-2.14.5"});
  ASSERT_TRUE(subject);
  model::DdsProfile profile = subject->scenario.dds;
  profile.spdp.period = model::Nanoseconds{1'500'000'000};
  profile.sedp.piggyback_threshold_bytes = model::Bytes{8'000'000};
  const auto xml = deployable(*subject, profile, "two settings", specs);
  ASSERT_TRUE(xml) << to_string(xml.error());
  const auto again = read_back(*xml, subject->preset, specs);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->spdp, profile.spdp);
  EXPECT_EQ(again->sedp, profile.sedp);
  EXPECT_EQ(reference_to("x.xml", *subject), "x.xml@fastdds-2.14.5");
}

TEST(TuneDeploy, SaysWhatLinuxMustAllowAndWhatTheTransportCosts) {
  const auto subject = subject_of({"dds=fastdds-2.6.11"});
  ASSERT_TRUE(subject);
  model::DdsProfile profile = subject->scenario.dds;
  EXPECT_TRUE(prerequisites(*subject, profile).empty());
  profile.sedp.piggyback_threshold_bytes = model::Bytes{4'000'000};
  const auto list = prerequisites(*subject, profile);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_NE(list[0].find("net.core.wmem_max=4000000"), std::string::npos);
  EXPECT_NE(list[1].find("shared memory"), std::string::npos);
}

/// How far apart processes start is a knob like others, in words, where processors are known.
TEST(TuneSpace, SearchesLaunchPlans) {
  const auto fleet = read_subject("fleet-4x2x20", {}, "", specs);
  ASSERT_TRUE(fleet) << to_string(fleet.error());
  Space space;
  add_launch_plan(fleet->scenario, space);
  ASSERT_EQ(space.dimensions.size(), 1U);
  const Dimension& starts = space.dimensions.front();
  EXPECT_EQ(starts.key, launch::plan_key);
  EXPECT_EQ(starts.print(starts.unchanged), "process by process, 100ms apart");
  EXPECT_EQ(starts.print(starts.value_at(0)), "all at once");
  EXPECT_EQ(starts.print(starts.value_at(1)), "process by process, 2s apart");
  EXPECT_TRUE(starts.is_logarithmic());
  EXPECT_LT(starts.value_at(0.5), 100'000'000) << "in factors from 1 ms on";
  EXPECT_GT(starts.value_at(0.5), 10'000'000);
  EXPECT_EQ(starts.position_of(starts.value_at(0)), 0);
  EXPECT_EQ(space.plan(space.unchanged()), std::nullopt);
  EXPECT_EQ(space.plan({0}), (launch::Plan{launch::Order::at_once}));
  EXPECT_EQ(space.apply(fleet->scenario, {0}), fleet->scenario) << "runs follow it";
}

TEST(TuneSpace, SaysWhyALaunchPlanStaysAsItIs) {
  const auto why = [](const char* scenario, const std::vector<std::string>& changes) {
    const auto subject = read_subject(scenario, changes, "fastdds-2.6.11", specs);
    Space space;
    if (subject) add_launch_plan(subject->scenario, space);
    return space.fixed.size() == 1 ? space.fixed.front().why : std::string{};
  };
  EXPECT_NE(why("live-5x20", {}).find("hosts"), std::string::npos);
  EXPECT_NE(why("rejoin-fastdds", {}).find("first starts"), std::string::npos);
}

}  // namespace space_test
}  // namespace stormproof::tune
