// Short Fast DDS documents for tests, and what the reader says of them.
#pragma once

#include <algorithm>
#include <string>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "model/config/vendor/vendor_profile.hpp"

namespace stormproof::model::config::vendor {

/// A default participant with `rtps` in <rtps>, which stands at the beginning of line 4, after
/// `before`, in line 2. Places of tests count from there.
inline std::string document(const std::string& rtps, const std::string& before = {}) {
  return fmt::format(
      "<dds><profiles>\n{}\n<participant profile_name=\"p\" is_default_profile=\"true\"><rtps>\n"
      "{}\n</rtps></participant></profiles></dds>\n",
      before, rtps);
}

inline std::string discovery(const std::string& config) {
  return document("<builtin><discovery_config>" + config + "</discovery_config></builtin>");
}

inline std::string transport(const std::string& id, const std::string& type,
                             const std::string& rest) {
  return fmt::format(
      "<transport_descriptors><transport_descriptor><transport_id>{}</transport_id><type>{}</type>"
      "{}</transport_descriptor></transport_descriptors>",
      id, type, rest);
}

inline std::string only(const std::string& id) {
  return fmt::format(
      "<userTransports><transport_id>{}</transport_id></userTransports>"
      "<useBuiltinTransports>false</useBuiltinTransports>",
      id);
}

inline Result<VendorProfile> read_fastdds(const std::string& text,
                                          const Selection& selection = {}) {
  const auto root = parse_xml(text, "f.xml");
  if (!root) return root.error();
  return read_vendor_profile(*root, selection);
}

inline VendorProfile profile_of(const std::string& text, const Selection& selection = {}) {
  auto profile = read_fastdds(text, selection);
  EXPECT_TRUE(profile) << (profile ? "" : to_string(profile.error()));
  return profile ? *profile : VendorProfile{};
}

inline std::string error_of(const std::string& text, const Selection& selection = {}) {
  const auto profile = read_fastdds(text, selection);
  return profile ? "accepted" : to_string(profile.error());
}

/// The value of a knob in `changes`, with its place: "1s at 4:10", or "unchanged".
inline std::string change(const VendorProfile& profile, const std::string& section,
                          const std::string& key) {
  const Node* keys = profile.changes.find(section);
  const Node* value = keys == nullptr ? nullptr : keys->find(key);
  if (value == nullptr) return "unchanged";
  return fmt::format("{} at {}:{}", value->text, value->place.line, value->place.column);
}

/// The last setting of this path.
inline Setting setting(const VendorProfile& profile, const std::string& path) {
  const auto found = std::find_if(profile.settings.rbegin(), profile.settings.rend(),
                                  [&](const Setting& one) { return one.path == path; });
  EXPECT_NE(found, profile.settings.rend()) << path;
  return found == profile.settings.rend() ? Setting{} : *found;
}

/// The remarks as "error fastdds.outside 4:10", in the order of the file.
inline std::vector<std::string> remarks(const VendorProfile& profile) {
  std::vector<std::string> all;
  for (const Remark& remark : profile.remarks) {
    all.push_back(fmt::format("{} {} {}:{}", name_of(remark.severity), remark.rule,
                              remark.place.line, remark.place.column));
  }
  return all;
}

}  // namespace stormproof::model::config::vendor
