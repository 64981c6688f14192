// Each of the other choices is the profile with one knob changed, and every choice and delay that
// the implementation has is among them.
#include "model/config/knobs/other_choices.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "model/implementations.hpp"
#include "tests/model/config/knobs/knob_list.hpp"

namespace stormproof::model::config {
namespace other_choices_test {

DdsProfile profile_of(ImplementationKind implementation) {
  DdsProfile dds;
  dds.implementation = implementation;
  if (implementation_of(implementation) == ImplementationKind::paper) dds.amendments.emplace();
  return dds;
}

/// The values of a profile by key.
std::map<std::string, std::string> values(const DdsProfile& dds) {
  std::vector<KnobInfo> list;
  KnobLister lister{list, "dds."};
  DdsProfile copy = dds;
  visit_knobs(lister, copy);
  std::map<std::string, std::string> values;
  for (const KnobInfo& knob : list) values[knob.key] += knob.default_value.dump();
  return values;
}

class EachImplementation : public testing::TestWithParam<ImplementationKind> {};

TEST_P(EachImplementation, HasOtherChoicesThatDifferInOneKnob) {
  const DdsProfile dds = profile_of(GetParam());
  const auto before = values(dds);
  std::set<std::string> keys;
  for (const auto& knob : other_choices(dds)) {
    EXPECT_TRUE(keys.insert(knob.key).second) << knob.key << " twice";
    EXPECT_NE(knob.key, "dds.implementation");
    EXPECT_FALSE(knob.others.empty()) << knob.key;
    std::set<std::string> seen{before.at(knob.key)};
    for (const DdsProfile& other : knob.others) {
      const auto after = values(other);
      ASSERT_EQ(after.size(), before.size());
      for (const auto& [key, value] : after) {
        EXPECT_EQ(value != before.at(key), key == knob.key) << knob.key << " changes " << key;
      }
      EXPECT_TRUE(seen.insert(after.at(knob.key)).second) << knob.key << ": the same twice";
    }
  }
}

TEST_P(EachImplementation, HasAllWordsOfAChoice) {
  const DdsProfile dds = profile_of(GetParam());
  std::vector<KnobInfo> list;
  KnobLister lister{list, "dds."};
  DdsProfile copy = dds;
  visit_knobs(lister, copy);
  const auto others = other_choices(dds);
  for (const KnobInfo& knob : list) {
    if (knob.choices.size() < 2 || knob.key == "dds.implementation") continue;
    const auto found = std::ranges::find(others, knob.key, &OtherChoices::key);
    if (knob.presence == Presence::of_others) {
      EXPECT_EQ(found, others.end()) << knob.key;
      continue;
    }
    ASSERT_NE(found, others.end()) << knob.key;
    EXPECT_EQ(found->others.size() + 1, knob.choices.size()) << knob.key;
    const std::string written = values(dds).at(knob.key);
    if (written == "null") continue;  // the usual word of a choice that need not be written
    const bool is_truth_value = found->value == "true" || found->value == "false";
    EXPECT_EQ(is_truth_value ? found->value : '"' + found->value + '"', written);
  }
}

INSTANTIATE_TEST_SUITE_P(OtherChoices, EachImplementation, testing::ValuesIn(implementations),
                         [](const auto& test) { return std::string{traits_of(test.param).name}; });

TEST(OtherChoicesOfDelays, AreZeroOrOneNanosecond) {
  DdsProfile dds;
  const auto find = [&](const std::string& key) {
    const auto list = other_choices(dds);
    const auto found = std::ranges::find(list, key, &OtherChoices::key);
    return found == list.end() ? OtherChoices{} : *found;
  };
  dds.sedp.nack_response_delay = Nanoseconds{5'000'000};
  ASSERT_EQ(find("dds.sedp.nack_response_delay").others.size(), 1U);
  EXPECT_EQ(find("dds.sedp.nack_response_delay").others[0].sedp.nack_response_delay.count(), 0);
  dds.sedp.nack_response_delay = Nanoseconds{0};
  EXPECT_EQ(find("dds.sedp.nack_response_delay").others[0].sedp.nack_response_delay.count(), 1);
  // What must be positive has no other choice.
  EXPECT_TRUE(find("dds.sedp.heartbeat_period").others.empty());
}

}  // namespace other_choices_test
}  // namespace stormproof::model::config
