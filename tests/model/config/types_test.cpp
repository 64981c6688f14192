// Types that participants do not know (`deployment.types`): what a scenario may say, and what it
// means for the profile.
#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "model/fastdds/endpoints.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace types_test {

constexpr const char* four = "deployment.types={unknown_per_participant: 4}";

Result<Scenario> read(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), "dds=fastdds-3.6");
  return read_scenario("live-5x20", overrides, source_specs());
}
std::string refused(std::vector<std::string> overrides) {
  const auto scenario = read(std::move(overrides));
  return scenario ? "" : to_string(scenario.error());
}

TEST(Types, AreAbsentUnlessSomebodySaysHowManyAreUnknown) {
  EXPECT_FALSE(read({})->deployment.types);
  EXPECT_EQ(read({four})->deployment.types, EndpointTypes{4});
  EXPECT_EQ(read({"deployment.types.unknown_per_participant=0"})->deployment.types,
            EndpointTypes{0});
}

TEST(Types, MakeDescriptorsLarger) {
  const auto extra = [](const Result<Scenario>& scenario) {
    return fastdds::deployed_profile(*scenario).version.descriptor_extra_bytes.count();
  };
  EXPECT_EQ(extra(read({})), 0);
  EXPECT_EQ(extra(read({four})), 188);
  EXPECT_EQ(extra(read({four, "dds.descriptor_extra_bytes=92"})), 92);
}

TEST(Types, OfMoreEndpointsThanThereAreAreRefused) {
  EXPECT_TRUE(read({"deployment.types.unknown_per_participant=32"}));
  EXPECT_NE(refused({"deployment.types.unknown_per_participant=33"})
                .find("deployment.types.unknown_per_participant: '33'"),
            std::string::npos)
      << refused({"deployment.types.unknown_per_participant=33"});
}

TEST(Types, OfAParticipantThatDoNotFitIntoOneAnswerAreRefused) {
  const std::vector<std::string> large{four, "dds.type_object_bytes=9000"};
  EXPECT_TRUE(read(large));
  std::vector<std::string> at_once = large;
  at_once.push_back("dds.typelookup_unit=participant");
  EXPECT_NE(refused(at_once).find("dds.typelookup_unit: 'participant'"), std::string::npos)
      << refused(at_once);
}

TEST(Types, AreRefusedWhereNoRuleSaysWhatHappens) {
  for (const std::vector<std::string>& others :
       std::vector<std::vector<std::string>>{{"dds.discovery=server"},
                                             {"wireless.lost_packets=[7]"},
                                             {"vary.loss=1/100"},
                                             {"vary.restarts=1"},
                                             {"deployment.life.lease=20s"}}) {
    std::vector<std::string> overrides = others;
    EXPECT_TRUE(read(overrides)) << others.front() << ": " << refused(overrides);
    overrides.emplace_back(four);
    EXPECT_NE(refused(overrides).find("deployment.types"), std::string::npos)
        << others.front() << ": " << refused(overrides);
  }
  EXPECT_FALSE(
      read_scenario("live-5x20", std::vector<std::string>{"dds=paper", four}, source_specs()));
}

}  // namespace types_test
}  // namespace stormproof::model::config
