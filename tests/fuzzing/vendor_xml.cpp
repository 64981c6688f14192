// Fuzz target: XML files of DDS vendors. What is accepted becomes a profile; unless the file
// describes another system or one that the vendor's library refuses, that profile is valid.
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/profile_files.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_profile.hpp"
#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/memory_file.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {
namespace {

namespace config = model::config;
namespace vendor = config::vendor;

/// A tree of maps as YAML; the texts of `unmodelled` need quotes, numbers must not have any.
std::string yaml_of(const config::Node& node, bool is_text = false) {
  if (!node.is_map()) return is_text ? nlohmann::json(node.text).dump() : node.text;
  std::string text = "{";
  for (const config::Member& member : node.members) {
    text += nlohmann::json(member.key).dump() + ": " +
            yaml_of(member.value, member.key == "unmodelled" || is_text) + ", ";
  }
  return text + "}";
}

bool has_place(const config::Place& place) {
  return place.source != nullptr && place.line > 0 && place.column > 0;
}

/// Whether a run of the system is possible, as far as the reader says.
bool describes_a_run(const vendor::VendorProfile& profile) {
  for (const vendor::Setting& setting : profile.settings) {
    if (setting.effect == vendor::Effect::outside || setting.effect == vendor::Effect::unknown) {
      return false;
    }
  }
  return true;
}

void check_settings(const vendor::VendorProfile& profile) {
  for (const vendor::Setting& setting : profile.settings) {
    require(has_place(setting.place), "a setting has a place");
    require(!setting.path.empty(), "a setting has a path");
    require(setting.effect != vendor::Effect::knob || !setting.knob.empty(),
            "a setting that sets a knob names it");
  }
  for (const vendor::Remark& remark : profile.remarks) {
    require(has_place(remark.place), "a remark has a place");
    require(!remark.rule.empty() && !remark.message.empty(), "a remark has a rule and a message");
  }
}

}  // namespace

Outcome vendor_xml(std::string_view input) {
  const auto document = vendor::parse_vendor_xml(input, "input.xml");
  const auto profile = document ? vendor::read_vendor_profile(*document, {})
                                : config::Result<vendor::VendorProfile>{document.error()};
  if (!profile) {
    require(!profile.error().where.empty(), "an error has a place");
    require(!profile.error().message.empty(), "an error says what is wrong");
    return Outcome::refused;
  }
  check_settings(*profile);
  if (!describes_a_run(*profile)) return Outcome::accepted;
  const auto read =
      config::read_dds_profile(MemoryFile{yaml_of(profile->changes)}.path(), {}, specs());
  require(bool{read}, "a vendor's file that was accepted is a valid profile");
  const std::string text = config::effective_json(*read).dump();
  const auto again = config::read_dds_profile(MemoryFile{text}.path(), {}, specs());
  require(again && *again == *read, "an effective profile reads back as an equal one");
  return Outcome::accepted;
}

}  // namespace stormproof::fuzzing
