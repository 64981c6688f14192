// The tables of what a user can change hold every knob of the vendor's presets, once, and nothing
// else; what they call settable has a range that holds the presets' own values.
#include "model/config/vendor/vendor_knobs.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/scenario.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config::vendor {
namespace vendor_knobs_test {

DdsProfile preset(const std::string& name) {
  const auto profile = read_dds_profile(name, {}, source_specs());
  EXPECT_TRUE(profile) << to_string(profile.error());
  return profile ? *profile : DdsProfile{};
}

std::vector<std::string> presets(Vendor vendor) {
  std::vector<std::string> names = source_specs().names(SpecKind::dds);
  std::erase_if(names, [&](const auto& name) { return vendor_of_preset(name) != vendor; });
  return names;
}

using Json = nlohmann::ordered_json;

void collect(const Json& json, const std::string& prefix, std::set<std::string>& keys) {
  for (const auto& [key, value] : json.items()) {
    if (prefix.empty() && key == "unmodelled") continue;
    if (value.is_object()) {
      collect(value, prefix + key + ".", keys);
    } else {
      keys.insert(prefix + key);
    }
  }
}

TEST(VendorKnobs, hold_every_key_of_the_presets_once) {
  for (const Vendor vendor : {Vendor::fastdds, Vendor::cyclonedds}) {
    std::set<std::string> expected{"max_participants_per_host", "spdp.lease"};  // of files alone
    for (const std::string& name : presets(vendor)) {
      collect(effective_json(preset(name)), "", expected);
    }
    std::multiset<std::string> found;
    for (const VendorKnob& knob : vendor_knobs(vendor)) found.emplace(knob.key);
    EXPECT_EQ(found, (std::multiset<std::string>{expected.begin(), expected.end()}))
        << name_of(vendor);
  }
}

/// What is written into XML is the number behind the key; no key stands for another one.
TEST(VendorKnobs, settable_ones_are_numbers_or_choices) {
  for (const Vendor vendor : {Vendor::fastdds, Vendor::cyclonedds}) {
    for (const VendorKnob& knob : vendor_knobs(vendor)) {
      if (knob.setting.empty()) continue;
      const std::vector<std::string> names = presets(vendor);
      const bool is_number = std::ranges::any_of(names, [&](const std::string& name) {
        return numeric_knob(preset(name), knob.key).has_value();
      });
      EXPECT_EQ(is_number, !knob.is_choice()) << knob.key;
    }
  }
}

TEST(VendorKnobs, are_in_the_order_of_the_profile) {
  std::vector<std::string> order;
  const auto append = [&](const auto& self, const Json& part, const std::string& prefix) -> void {
    for (const auto& [key, value] : part.items()) {
      if (value.is_object()) {
        self(self, value, prefix + key + ".");
      } else {
        order.push_back(prefix + key);
      }
    }
  };
  for (const Vendor vendor : {Vendor::fastdds, Vendor::cyclonedds}) {
    DdsProfile profile =  // Fast DDS has profiles with the paper's writer, too
        preset(vendor == Vendor::fastdds ? "paper" : "cyclonedds-0.10");
    profile.unmodelled.clear();
    order.clear();
    append(append, effective_json(profile), "");
    if (vendor == Vendor::fastdds) {  // the other ways to discover have keys, which come first
      std::vector<std::string> own;
      DdsProfile server = preset("fastdds-server-2.6.11");
      server.server.known = ServerKnown::locator;  // written only if they are not the usual
      server.server.rejoin = Rejoin::known;
      for (const DdsProfile& other :
           {server, preset("fastdds-static-2.6.11"), preset("fastdds-3.6")}) {
        const Json json = effective_json(other);
        for (const auto& [key, value] : json.items()) {
          const bool is_new = std::ranges::find(own, key) == own.end();
          if (!value.is_object() && key != "implementation" && is_new) own.push_back(key);
        }
      }
      order.insert(order.begin() + 1, own.begin(), own.end());
    }
    // What no preset says has its place in the table, too.
    const auto before = [&order](const char* key, const char* next) {
      order.insert(std::ranges::find(order, next), key);
    };
    before("max_participants_per_host",
           vendor == Vendor::fastdds ? "match_order" : "allow_multicast");
    if (vendor == Vendor::cyclonedds) {
      before("spdp.initial_prune_delay", "sedp.heartbeat_interval");
      before("spdp.discovered_prune_delay", "sedp.heartbeat_interval");
    }
    before("spdp.lease",
           vendor == Vendor::fastdds ? "sedp.heartbeat_period" : "sedp.heartbeat_interval");
    std::vector<std::string> found;
    for (const VendorKnob& knob : vendor_knobs(vendor)) found.emplace_back(knob.key);
    EXPECT_EQ(found, order);
  }
}

TEST(VendorKnobs, say_why_or_where) {
  for (const Vendor vendor : {Vendor::fastdds, Vendor::cyclonedds}) {
    for (const VendorKnob& knob : vendor_knobs(vendor)) {
      EXPECT_TRUE(!knob.setting.empty() || !knob.why.empty()) << knob.key;
      EXPECT_EQ(knob.setting.empty() || knob.is_choice(), knob.maximum == 0) << knob.key;
      EXPECT_LE(knob.minimum, knob.maximum) << knob.key;
    }
  }
}

TEST(VendorKnobs, ranges_lie_within_those_of_the_model) {
  std::set<std::pair<Vendor, std::string_view>> seen;
  for (const std::string name : {"fastdds-2.6.11", "fastdds-server-2.6.11", "fastdds-static-2.6.11",
                                 "cyclonedds-0.10", "cyclonedds-11"}) {
    Scenario scenario;
    scenario.dds = preset(name);
    const std::vector<NumericKnob> numbers = numeric_knobs(scenario);
    for (const VendorKnob& knob : vendor_knobs(*vendor_of_preset(name))) {
      if (knob.setting.empty() || knob.is_choice()) continue;
      const auto number =
          std::ranges::find(numbers, "dds." + std::string{knob.key}, &NumericKnob::key);
      if (number == numbers.end()) continue;  // of another way to discover
      seen.emplace(*vendor_of_preset(name), knob.key);
      EXPECT_GE(knob.minimum, number->minimum) << knob.key;
      EXPECT_LE(knob.maximum, number->maximum) << knob.key;
      EXPECT_GE(number->value, knob.minimum) << knob.key;
      EXPECT_LE(number->value, knob.maximum) << knob.key;
    }
  }
  for (const Vendor vendor : {Vendor::fastdds, Vendor::cyclonedds}) {
    for (const VendorKnob& knob : vendor_knobs(vendor)) {
      const bool is_number = !knob.setting.empty() && !knob.is_choice();
      EXPECT_EQ(seen.contains({vendor, knob.key}), is_number) << knob.key;
    }
  }
}

TEST(VendorKnobs, presets_by_name) {
  EXPECT_EQ(vendor_of_preset("fastdds-2.14.5"), Vendor::fastdds);
  EXPECT_EQ(vendor_of_preset("cyclonedds-0.10"), Vendor::cyclonedds);
  EXPECT_EQ(vendor_of_preset("paper"), std::nullopt);
  EXPECT_EQ(vendor_of_preset(""), std::nullopt);
  EXPECT_GE(presets(Vendor::fastdds).size(), 3U);
  EXPECT_EQ(presets(Vendor::cyclonedds).size(), 3U);
}

}  // namespace vendor_knobs_test
}  // namespace stormproof::model::config::vendor
