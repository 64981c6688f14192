// Short Cyclone DDS documents for tests, and what the reader makes of them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_profile.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config::vendor::cyclonedds_test {

/// `settings` stand in line 2.
inline std::string domain(const std::string& settings) {
  return fmt::format("<CycloneDDS><Domain Id=\"any\">\n{}\n</Domain></CycloneDDS>", settings);
}
inline std::string internal(const std::string& settings) {
  return domain("<Internal>" + settings + "</Internal>");
}
inline std::string discovery(const std::string& settings) {
  return domain("<Discovery>" + settings + "</Discovery>");
}

inline Result<VendorProfile> parse(const std::string& text, const std::string& id = {}) {
  const auto root = parse_xml(text, "c.xml");
  if (!root) return root.error();
  return read_cyclonedds_profile(*root, {id, ""});
}

inline VendorProfile read(const std::string& text, const std::string& id = {}) {
  auto profile = parse(text, id);
  EXPECT_TRUE(profile) << to_string(profile.error()) << "\n" << text;
  return profile ? *std::move(profile) : VendorProfile{};
}

inline std::string error(const std::string& text, const std::string& id = {}) {
  const auto profile = parse(text, id);
  EXPECT_FALSE(profile) << text;
  return profile ? "" : to_string(profile.error());
}

/// "value@line:column" of a key of the changes, or "-".
inline std::string change(const VendorProfile& profile, const std::string& section,
                          const std::string& key) {
  const Node* map = profile.changes.find(section);
  const Node* value = map == nullptr ? nullptr : map->find(key);
  if (value == nullptr) return "-";
  return fmt::format("{}@{}:{}", value->text, value->place.line, value->place.column);
}

/// "severity rule line" of every remark.
inline std::vector<std::string> remarks(const VendorProfile& profile) {
  std::vector<std::string> all;
  for (const Remark& remark : profile.remarks) {
    all.push_back(
        fmt::format("{} {} {}", name_of(remark.severity), remark.rule, remark.place.line));
  }
  return all;
}
using Remarks = std::vector<std::string>;

inline const Setting& setting(const VendorProfile& profile, const std::string& path) {
  static const Setting absent;
  const auto found = std::ranges::find(profile.settings, path, &Setting::path);
  EXPECT_NE(found, profile.settings.end()) << path;
  return found == profile.settings.end() ? absent : *found;
}

inline DdsProfile resolved(const std::string& text, const std::string& suffix = {}) {
  const TestFiles files{};
  const auto profile = read_dds_profile(files.write("c.xml", text) + suffix, {}, source_specs());
  EXPECT_TRUE(profile) << to_string(profile.error());
  return profile ? *profile : DdsProfile{};
}

inline DdsProfile preset() {
  const auto profile = read_dds_profile("cyclonedds-0.10", {}, source_specs());
  EXPECT_TRUE(profile) << to_string(profile.error());
  return profile ? *profile : DdsProfile{};
}

}  // namespace stormproof::model::config::vendor::cyclonedds_test
