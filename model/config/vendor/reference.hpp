// A reference to a vendor's XML file where a profile may be named: "FILE.xml", with "#PROFILE" to
// choose one of several participant profiles (or Cyclone DDS domains) in it and "@PRESET" to say
// which version of the library reads it: "robots.xml#lidar@fastdds-2.14.5". A Cyclone DDS
// configuration may also be given itself, as CYCLONEDDS_URI may have it: "<General>…</>@PRESET".
#pragma once

#include <optional>
#include <string>

#include "model/config/vendor/vendor_profile.hpp"

namespace stormproof::model::config::vendor {

struct FileReference {
  std::string file;  ///< empty: `text` is it
  std::string text = {};
  Selection selection;
};

/// Takes `reference` apart if it names an XML file; otherwise nothing. A file whose own name has a
/// '#' or '@' is found, too, if it ends in ".xml".
[[nodiscard]] std::optional<FileReference> parse_reference(const std::string& reference);

}  // namespace stormproof::model::config::vendor
