// What the vendors' own parsers take although it is not well-formed XML, mended so that a strict
// parser takes it, too: their files are judged by what their libraries read. Facts: tinyxml2, which
// Fast DDS uses, ends a comment at the first "-->", skips blanks before the declaration and keeps
// every top-level element; Cyclone DDS 0.10's parser (ddsrt/src/xmlparser.c) does the first two as
// well, and in CYCLONEDDS_URI itself it takes `</>` for the end of whatever is open and the end of
// the text for all ends that are missing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stormproof::model::config::vendor {

// As XML has them.
inline constexpr std::string_view blanks = " \t\r\n";
inline constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

enum class XmlOddity : std::uint8_t {
  hyphens,       ///< "--" inside of a comment
  blanks,        ///< white space before <?xml …?>
  second_root,   ///< an element beside the root element
  nameless_end,  ///< </>
  missing_end,   ///< the text ends before an element does
  no_root        ///< settings without the root element around them
};

struct MendedXml {
  struct Found {
    XmlOddity oddity{};
    std::size_t offset = 0;  ///< in the original text, in bytes
  };

  std::string text;
  std::vector<Found> oddities{};  ///< in the order of the text; empty: nothing was mended
  bool is_wrapped = false;  ///< all top-level elements stand in one that is no part of the file

  /// Where the byte of `text` stands in the original; what was put in has the place of what
  /// follows.
  [[nodiscard]] std::size_t original(std::size_t offset) const;

  struct Insertion {
    std::size_t at = 0;      ///< in `text`
    std::size_t length = 0;  ///< bytes
    std::size_t before = 0;  ///< bytes of those that stand before it
  };
  std::vector<Insertion> insertions{};  ///< in the order of the text
};

/// Looks at markup only: what is wrong beyond the oddities stays as it is, for the parser to
/// refuse.
[[nodiscard]] MendedXml mend_xml(std::string_view text);

}  // namespace stormproof::model::config::vendor
