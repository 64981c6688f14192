// Which knobs of the model a user of a vendor's library can change, and where: one table for each
// vendor, from which `profile show` says what is a constant, `tune` knows what it may search, and
// the XML writer knows what to write.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "model/config/vendor/vendor_profile.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::model::config::vendor {

struct VendorKnob {
  std::string_view key;      ///< of the model: "spdp.period"
  std::string_view setting;  ///< element that sets it ("…/leaseAnnouncement"), empty: a user cannot
  std::string_view why;      ///< if not: "constant in the library, EDPSimple.cpp:54"; otherwise how
                             ///< the element's value relates to the knob's, or empty
  std::int64_t minimum = 0;  ///< that the library and a sensible deployment allow, in the knob's
  std::int64_t maximum = 0;  ///< unit; both 0 if a user cannot change it, or it is a choice

  /// A user chooses among words.
  [[nodiscard]] constexpr bool is_choice() const { return !setting.empty() && maximum == 0; }
};

/// Every knob that the vendor's implementation in the model has (`numeric` or not), in the order of
/// the profile's table.
[[nodiscard]] std::span<const VendorKnob> vendor_knobs(Vendor vendor);

/// Whose library a preset or a profile based on one describes: by the name of the outermost preset
/// ("fastdds-…", "cyclonedds-…"). Nothing for the paper's profiles.
[[nodiscard]] std::optional<Vendor> vendor_of_preset(std::string_view preset);

/// XML, ready to deploy, that makes the library of `preset` behave like `profile`: the elements of
/// all knobs that differ between `base` (what the preset says) and `profile`, with a comment beside
/// each. An error names the first knob that differs and that no user can change. Read back on top
/// of the preset it gives `profile`.
[[nodiscard]] Result<std::string> write_vendor_xml(Vendor vendor, std::string_view preset,
                                                   const DdsProfile& base,
                                                   const DdsProfile& profile,
                                                   const std::string& comment);

}  // namespace stormproof::model::config::vendor
