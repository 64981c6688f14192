// One profile of a Fast DDS file, read by the table of its elements: every value as the library
// itself would read it, with a remark where that is not what it seems.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/vendor/fastdds_schema.hpp"
#include "model/config/vendor/vendor_profile.hpp"

namespace stormproof::model::config::vendor::fastdds {

/// What ends the reading of a file: a value that the library refuses. Caught where the reading
/// begins, in `read_fastdds_profile`.
struct Refusal {
  InputError error;
};
[[noreturn]] void refuse(const Place& place, std::string message);

/// The value of an element.
struct Value {
  std::int64_t number = 0;  ///< ns of a duration; 0 or 1 of a flag; number of elements of a list
  bool infinite = false;    ///< of a duration; then `number` is the longest one
  std::string shown;        ///< as a person reads it
  Place place;              ///< of its text, or of the element
  std::vector<std::string> items = {};  ///< of a list
};

/// An element with a value.
struct Found {
  const SchemaItem* item = nullptr;
  const XmlElement* element = nullptr;
  Value value;
  std::size_t setting = 0;  ///< index in `VendorProfile::settings`
};

struct Section {
  std::vector<Found> found;

  /// The element with this path (or property with this name) that counts: the last one. Null if
  /// there is none.
  [[nodiscard]] const Found* find(std::string_view path) const;
};

/// How a section is read.
struct SectionRules {
  std::span<const SchemaItem> schema;
  Version version = oldest_version;
  std::string prefix = {};             ///< put before the paths of settings
  unsigned transport = any_transport;  ///< kind of a transport descriptor
  bool refuses_repetition = false;     ///< an element that comes twice makes the file invalid
};

/// Reads all elements below `element`; settings and remarks go into `profile`. A setting has the
/// effect that the table names, or none if its value is the library's default.
[[nodiscard]] Section read_section(const XmlElement& element, const SectionRules& rules,
                                   VendorProfile& profile);

/// Reads one value. `profile` gets the remarks.
[[nodiscard]] Value read_value(const XmlElement& element, const SchemaItem& item,
                               VendorProfile& profile);
/// "udpv4 192.0.2.5:11811". An address that is none makes the library refuse the file.
[[nodiscard]] std::string read_locator(const XmlElement& locator, VendorProfile& profile);
/// A number at the start of `text`, as `std::stoul` and `sscanf` find it, and the rest.
struct LeadingNumber {
  std::int64_t number = 0;
  std::string_view rest;
};
[[nodiscard]] std::optional<LeadingNumber> leading_number(std::string_view text);

void add_remark(VendorProfile& profile, Severity severity, std::string rule, const Place& place,
                std::string message, std::string hint = {});

}  // namespace stormproof::model::config::vendor::fastdds
