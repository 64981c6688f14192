// The list of knobs is complete, has no duplicates, and its keys are those that `--set` takes.
#include "model/config/knob_list.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace {

TEST(KnobList, every_knob_is_there_once_with_its_documentation) {
  std::set<std::string> keys;
  for (const KnobInfo& knob : scenario_knob_list()) {
    EXPECT_TRUE(keys.insert(knob.key).second) << knob.key;
    EXPECT_FALSE(knob.doc.empty()) << knob.key;
    EXPECT_FALSE(knob.type.expected.empty()) << knob.key;
    EXPECT_FALSE(knob.type.schema.empty()) << knob.key;
    EXPECT_TRUE(!knob.type.minimum.empty() || !knob.type.choices.empty() ||
                knob.type.name == "text")
        << knob.key;
  }
  for (const char* key :
       {"time_limit", "deployment.hosts", "deployment.participants.*.start", "dds.implementation",
        "dds.sedp.heartbeat_period", "dds.sedp.adaptive.epsilon", "dds.descriptors.default_bytes",
        "wireless.source_queue_bytes", "wireless.stages.*.rate_multicast"}) {
    EXPECT_TRUE(keys.contains(key)) << key;
  }
}

TEST(KnobList, defaults_ranges_and_choices_can_be_set) {
  for (const KnobInfo& knob : scenario_knob_list()) {
    if (knob.key.starts_with("deployment.") || knob.key == "dds.implementation") continue;
    std::string key = knob.key;
    if (const auto star = key.find('*'); star != std::string::npos) key.replace(star, 1, "0");
    std::vector<std::string> values = knob.type.choices;
    if (!knob.default_value.is_null() && !(knob.type.name == "text"))
      values.push_back(knob.default_value.dump());
    for (const std::string& value : values) {
      const std::vector<std::string> overrides{key + "=" + value};
      const auto scenario = read_scenario("wifi-5x20", overrides, source_specs());
      EXPECT_TRUE(scenario) << to_string(scenario.error());
    }
  }
}

}  // namespace
}  // namespace stormproof::model::config
