// A distribution's name means a shipped profile wherever a profile may be named, and says which
// version it stands for.
#include "model/config/distributions.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace distributions_test {

std::vector<Distribution> shipped() {
  const auto all = read_distributions(source_specs().directories);
  EXPECT_TRUE(all) << to_string(all.error());
  return all ? *all : std::vector<Distribution>{};
}

TEST(Distributions, ShippedOnesStandForShippedProfiles) {
  const SpecPath specs = source_specs();
  const std::vector<std::string> profiles = specs.names(SpecKind::dds);
  std::vector<std::string> names;
  for (const Distribution& one : shipped()) {
    names.push_back(one.name);
    EXPECT_EQ(std::ranges::count(profiles, one.profile), 1) << one.name << ": " << one.profile;
    EXPECT_EQ(std::ranges::count(profiles, one.name), 0) << one.name << " hides a profile";
    const auto meant = trace_dds_profile(one.name, {}, specs);
    ASSERT_TRUE(meant) << to_string(meant.error());
    EXPECT_EQ(meant->preset, one.profile);
    EXPECT_EQ(meant->value, *read_dds_profile(one.profile, {}, specs));
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"humble", "iron", "jazzy", "kilted", "lyrical", "rolling"}));
}

TEST(Distributions, SayWhenTheVersionIsAnother) {
  const Distribution same{"foxy", "Fast DDS 2.1.4", "fastdds-2.1.4", "the same", ""};
  EXPECT_FALSE(stands_in(same));
  EXPECT_EQ(statement_of(same), "ROS 2 foxy ships Fast DDS 2.1.4, which fastdds-2.1.4 describes");
  for (const Distribution& one : shipped()) {
    EXPECT_TRUE(stands_in(one)) << one.name;
    EXPECT_NE(statement_of(one).find(one.profile + " stands for it: " + one.why),
              std::string::npos);
  }
}

TEST(Distributions, GoWhereverAProfileMayBeNamed) {
  const SpecPath specs = source_specs();
  const std::vector<std::string> set{"dds=jazzy", "dds.spdp.period=7s"};
  const auto scenario = trace_scenario("smallest", set, specs);
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(scenario->preset, "fastdds-2.14.5");
  EXPECT_EQ(scenario->value.dds.spdp.period, Nanoseconds{7'000'000'000});
  const TestFiles files{};
  const std::string mine = files.write("mine.yaml", "base: kilted\n");
  EXPECT_EQ(trace_dds_profile(mine, {}, specs)->preset, "fastdds-3.2");
  const std::string xml = specs.directories.front() + "/vendor/";
  const auto fast = trace_dds_profile(xml + "fastdds/humble-default.xml@jazzy", {}, specs);
  ASSERT_TRUE(fast) << to_string(fast.error());
  EXPECT_EQ(fast->preset, "fastdds-2.14.5");
}

/// A distribution ships both libraries; whose file it is decides which version reads it.
TEST(Distributions, HaveAVersionOfTheVendorWhoseFileItIs) {
  const SpecPath specs = source_specs();
  const std::string xml = specs.directories.front() + "/vendor/";
  const auto preset = [&](const std::string& reference) {
    const auto traced = trace_dds_profile(xml + reference, {}, specs);
    return traced ? traced->preset : to_string(traced.error());
  };
  EXPECT_EQ(preset("cyclonedds/default.xml@humble"), "cyclonedds-0.10");
  EXPECT_EQ(preset("cyclonedds/default.xml@lyrical"), "cyclonedds-11");
  EXPECT_EQ(preset("fastdds/humble-default.xml@humble"), "fastdds-2.6.11");
  EXPECT_EQ(preset("fastdds/humble-default.xml@kilted"), "fastdds-3.2");
  const auto other = trace_dds_profile(xml + "cyclonedds/default.xml@fastdds-3.2", {}, specs);
  ASSERT_FALSE(other);
  EXPECT_NE(to_string(other.error()).find("'fastdds-3.2' is a preset of Fast DDS"),
            std::string::npos);
  // The library of the distribution knows the property, that of an earlier one does not.
  const TestFiles files{};
  const std::string file = files.write(
      "types.xml",
      "<dds><profiles><participant profile_name='p' is_default_profile='true'><rtps>"
      "<propertiesPolicy><properties><property><name>fastdds.type_propagation</name>"
      "<value>disabled</value></property></properties></propertiesPolicy></rtps></participant>"
      "</profiles></dds>");
  const auto lyrical = trace_dds_profile(file + "@lyrical", {}, specs);
  ASSERT_TRUE(lyrical) << to_string(lyrical.error());
  EXPECT_EQ(lyrical->value.version.type_lookup, Whether::no);
  EXPECT_TRUE(lyrical->vendor->remarks.empty());
  const auto jazzy = trace_dds_profile(file + "@jazzy", {}, specs);
  ASSERT_TRUE(jazzy) << to_string(jazzy.error());
  EXPECT_EQ(jazzy->vendor->remarks.front().rule, "fastdds.later-property");
}

TEST(Distributions, AFileOfTheNameWins) {
  const TestFiles files{};
  files.write("dds/humble.yaml", "base: paper\n");
  const SpecPath specs{{files.root(), STORMPROOF_SPECS_DIR}};
  EXPECT_EQ(trace_dds_profile("humble", {}, specs)->preset, "humble");
}

TEST(Distributions, AreAmongTheNames) {
  const auto unknown = read_dds_profile("humbel", {}, source_specs());
  ASSERT_FALSE(unknown);
  EXPECT_NE(to_string(unknown.error()).find("did you mean 'humble'?"), std::string::npos);
}

/// Nobody is left alone with a name that was shipped; what is named instead is there.
TEST(Distributions, RetiredProfilesNameTheirSuccessor) {
  for (const std::string name : {"fastdds-3.4", "fastdds-server-3.5"}) {
    const auto successor = successor_of(source_specs().directories, name);
    ASSERT_TRUE(successor) << to_string(successor.error());
    EXPECT_TRUE(read_dds_profile(*successor, {}, source_specs())) << *successor;
    EXPECT_EQ(to_string(read_dds_profile(name, {}, source_specs()).error()),
              name + ": '" + name + "' is not shipped any more; expected " + *successor +
                  " in its place");
  }
  EXPECT_EQ(*successor_of(source_specs().directories, "fastdds-3.6"), "");
  EXPECT_EQ(*successor_of({"/none"}, "fastdds-3.4"), "");
}

TEST(Distributions, MistakesHaveTheirPlace) {
  const auto error_of = [](const std::string& text) {
    const TestFiles files{};
    const std::string file = files.write("distributions.yaml", text);
    const auto all = read_distributions({files.path("none"), files.root()});
    return all ? "" : to_string(all.error()).substr(file.size());
  };
  EXPECT_EQ(error_of("distributions: [a]"),
            ":1:16: distributions: a list; expected a map of distributions");
  EXPECT_EQ(error_of("distributions:\n  a: {ships: x, profile: paper}"),
            ":2:6: distributions.a.why: missing; expected text");
  EXPECT_EQ(error_of("distributions:\n  a: {ships: [x], profile: paper, why: z}"),
            ":2:14: distributions.a.ships: a list; expected text");
  EXPECT_EQ(error_of("distributions:\n  a: {shipps: x, profile: paper, why: z}"),
            ":2:7: unknown key 'shipps' in distributions.a; did you mean 'ships'?");
  EXPECT_TRUE(read_distributions({"/none"})->empty());
  const TestFiles files{};  // an unknown name tells of the mistake
  files.write("distributions.yaml", "distribution: {}");
  EXPECT_NE(to_string(read_dds_profile("humble", {}, {{files.root()}}).error())
                .find("unknown key 'distribution'"),
            std::string::npos);
}

}  // namespace distributions_test
}  // namespace stormproof::model::config
