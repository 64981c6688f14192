// XML text to a tree that knows its places, for the profiles that DDS vendors read. Such a file
// comes from anywhere, so what this accepts is bounded, and nothing outside of the text is ever
// looked at: a document type declaration, and with it every entity of its own, is refused.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/tree/tree.hpp"
#include "model/config/vendor/xml_mend.hpp"

namespace stormproof::model::config::vendor {

inline constexpr std::size_t max_xml_bytes = 4 * 1024 * 1024;
inline constexpr std::size_t max_xml_depth = 64;
inline constexpr std::size_t max_xml_elements = 100'000;
inline constexpr std::size_t max_xml_name_bytes = 256;  ///< of an element or attribute

struct XmlAttribute {
  std::string name;
  std::string value;
};

struct XmlElement {
  std::string name;  ///< local name, without a namespace prefix
  Place place;       ///< of its '<'
  std::string text;  ///< all character data directly in it, trimmed
  Place text_place;  ///< of the first character of `text`; `place` if there is none
  std::vector<XmlAttribute> attributes;  ///< in the order of the file
  std::vector<XmlElement> children;

  /// The first child with this name, or null.
  [[nodiscard]] const XmlElement* find(std::string_view child) const;
  /// The value of an attribute, or null.
  [[nodiscard]] const std::string* attribute(std::string_view name_of_it) const;
};

/// The root element. `source` is the name in error messages. Errors, each with line and column: not
/// well-formed, not UTF-8 (or another encoding that the declaration names and the parser knows), a
/// document type declaration, a text, name, depth or number of elements over the limits.
[[nodiscard]] Result<XmlElement> parse_xml(std::string_view text, const std::string& source);

/// At most so many are named.
inline constexpr std::size_t max_xml_oddities = 20;

/// A text that a vendor's own parser may take although it is not well-formed XML (xml_mend.hpp).
struct XmlDocument {
  struct Odd {
    XmlOddity oddity{};
    Place place;
  };

  std::vector<XmlElement> roots;                   ///< one at least
  std::vector<Odd> oddities{};                     ///< in the order of the text
  bool is_variable = false;                        ///< it is what CYCLONEDDS_URI holds, not a file
  std::optional<InputError> not_well_formed = {};  ///< what a strict parser says; if odd
};

/// As `parse_xml`, but for the oddities. An error: of what is wrong beyond them.
[[nodiscard]] Result<XmlDocument> parse_vendor_xml(std::string_view text,
                                                   const std::string& source);

/// Reads a file; in addition: not readable, a directory, longer than `max_xml_bytes`.
[[nodiscard]] Result<XmlDocument> load_xml(const std::string& path);

}  // namespace stormproof::model::config::vendor
