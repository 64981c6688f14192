// The names of what a vendor's file can say, and which vendor a file is for.
#include "model/config/vendor/vendor_profile.hpp"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "model/config/vendor/cyclonedds_values.hpp"

namespace stormproof::model::config::vendor {

const char* name_of(Vendor vendor) {
  return vendor == Vendor::fastdds ? "Fast DDS" : "Cyclone DDS";
}

const char* name_of(Effect effect) {
  constexpr std::array names{"knob", "none", "unmodelled", "outside", "unknown"};
  return names[static_cast<std::size_t>(effect)];
}

const char* name_of(Severity severity) {
  constexpr std::array names{"error", "warning", "note"};
  return names[static_cast<std::size_t>(severity)];
}

std::string_view default_base(Vendor vendor) {
  return vendor == Vendor::fastdds ? "fastdds-2.6.11" : "cyclonedds-0.10";
}

std::optional<Vendor> vendor_of(const XmlElement& root) {
  constexpr std::array<std::string_view, 3> fastdds_roots{"dds", "profiles", "participant"};
  if (std::ranges::find(fastdds_roots, root.name) != fastdds_roots.end()) return Vendor::fastdds;
  if (is_same_word(root.name, "CycloneDDS")) return Vendor::cyclonedds;
  return std::nullopt;
}

Result<VendorProfile> read_vendor_profile(const XmlElement& root, const Selection& selection) {
  const std::optional<Vendor> vendor = vendor_of(root);
  if (!vendor) {
    return error_at(root.place,
                    fmt::format("root element <{}>; expected <dds>, <profiles> or <participant> of "
                                "Fast DDS, or <CycloneDDS>",
                                root.name));
  }
  return *vendor == Vendor::fastdds ? read_fastdds_profile(root, selection)
                                    : read_cyclonedds_profile(root, selection);
}

}  // namespace stormproof::model::config::vendor
