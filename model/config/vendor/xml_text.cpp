// XML text to a tree, on expat. Expat checks that the text is well-formed; this file keeps the
// places, counts what it builds, and stops at the first document type declaration, before an entity
// could be declared. Namespaces are no part of what the vendors' libraries read, so names lose
// their prefix.
#include "model/config/vendor/xml_text.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include <expat.h>
#include <fmt/core.h>

#include "model/config/tree/file_text.hpp"

namespace stormproof::model::config::vendor {
namespace {

std::string_view local_name(std::string_view name) {
  if (name.ends_with(':')) return name;     // no prefix, though expat takes it for a name
  return name.substr(name.rfind(':') + 1);  // npos + 1 is 0
}

/// Attributes that say how to read the text, not what it says.
bool is_about_the_text(std::string_view attribute) {
  return attribute == "xmlns" || attribute.starts_with("xmlns:") || attribute.starts_with("xsi:");
}

/// Lines and columns of byte offsets that never go back, in a text of one byte a character or in
/// UTF-8. Lines end as XML says: with LF, CR LF or CR.
class LineCounter {
 public:
  explicit LineCounter(std::string_view text)
      : text_{text}, line_start_{text.starts_with(utf8_mark) ? utf8_mark.size() : 0} {}

  void place_at(std::size_t offset, Place& place) {
    for (; next_ < std::min(offset, text_.size()); ++next_) {
      const bool is_crlf =
          text_[next_] == '\r' && next_ + 1 < text_.size() && text_[next_ + 1] == '\n';
      if (is_crlf || (text_[next_] != '\n' && text_[next_] != '\r')) continue;
      line_ += 1;
      line_start_ = next_ + 1;
    }
    place.line = line_;
    place.column = static_cast<int>(offset - std::min(offset, line_start_)) + 1;
  }

 private:
  std::string_view text_;
  std::size_t next_ = 0;
  std::size_t line_start_;
  int line_ = 1;
};

/// Receives expat's events and builds the tree of them.
class XmlBuilder {
 public:
  /// `mended`: what is parsed in place of `text`, in which the places are.
  XmlBuilder(std::string_view text, const std::string& source, const MendedXml* mended = nullptr)
      : text_{text},
        mended_{mended},
        source_{std::make_shared<const std::string>(source)},
        lines_{text},
        is_wide_{text.size() >= 2 &&
                 (text[0] == '\0' || text[1] == '\0' || text[0] == '\xFE' || text[0] == '\xFF')},
        parser_{XML_ParserCreate(nullptr), XML_ParserFree} {}

  Result<XmlElement> parse() {
    if (parser_ == nullptr) return InputError{*source_, "not enough memory to read XML"};
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const XML_Char* name, const XML_Char** attributes) {
          static_cast<XmlBuilder*>(self)->open(name, attributes);
        },
        [](void* self, const XML_Char*) { static_cast<XmlBuilder*>(self)->close(); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const XML_Char* text, int length) {
      static_cast<XmlBuilder*>(self)->add_text({text, static_cast<std::size_t>(length)});
    });
    XML_SetStartDoctypeDeclHandler(
        parser_.get(), [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
          static_cast<XmlBuilder*>(self)->refuse_doctype();
        });
    const std::string_view input = mended_ == nullptr ? text_ : mended_->text;
    const XML_Status status =
        XML_Parse(parser_.get(), input.data(), static_cast<int>(input.size()), XML_TRUE);
    if (refused_) return *refused_;
    if (status != XML_STATUS_OK) return syntax_error();
    return std::move(root_);
  }

 private:
  std::size_t offset() const {
    const auto parsed =
        static_cast<std::size_t>(std::max<XML_Index>(0, XML_GetCurrentByteIndex(parser_.get())));
    return mended_ == nullptr ? parsed : mended_->original(parsed);
  }

  Place here() {
    Place place{source_, 1, 1};
    if (is_wide_) {
      place.line = static_cast<int>(XML_GetCurrentLineNumber(parser_.get()));
      place.column = static_cast<int>(XML_GetCurrentColumnNumber(parser_.get())) + 1;
    } else {
      lines_.place_at(offset(), place);
    }
    return place;
  }

  void refuse(const Place& place, std::string message) {
    if (!refused_) refused_ = error_at(place, std::move(message));
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  void open(std::string_view name, const XML_Char** attributes) {
    if (refused_) return;
    XmlElement element;
    element.name = local_name(name);
    element.place = here();
    element.text_place = element.place;
    if (open_.size() == max_xml_depth) {
      return refuse(element.place, fmt::format("nested more than {} levels deep", max_xml_depth));
    }
    if (++elements_ > max_xml_elements) {
      return refuse(element.place, fmt::format("more than {} elements", max_xml_elements));
    }
    std::size_t longest = name.size();
    for (const XML_Char** one = attributes; *one != nullptr; one += 2) {
      longest = std::max(longest, std::string_view{*one}.size());
    }
    if (longest > max_xml_name_bytes) {
      return refuse(element.place, fmt::format("a name of {} bytes; expected {} at most", longest,
                                               max_xml_name_bytes));
    }
    for (; *attributes != nullptr; attributes += 2) {
      if (!is_about_the_text(attributes[0])) {
        element.attributes.push_back({attributes[0], attributes[1]});
      }
    }
    open_.push_back(std::move(element));
  }

  void close() {
    if (refused_) return;
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    element.text = std::string{trimmed(element.text)};
    if (open_.empty()) {
      root_ = std::move(element);
    } else {
      open_.back().children.push_back(std::move(element));
    }
  }

  void add_text(std::string_view text) {
    if (refused_ || open_.empty()) return;
    XmlElement& element = open_.back();
    if (trimmed(element.text).empty()) {
      const std::size_t first = text.find_first_not_of(blanks);
      if (first == std::string_view::npos) return;  // blanks before the text are trimmed anyway
      element.text_place = here();
      element.text_place.column += static_cast<int>(first);
    }
    element.text += text;
  }

  void refuse_doctype() {
    Place place = here();
    const std::size_t start = text_.substr(0, offset()).rfind("<!DOCTYPE");
    if (!is_wide_ && start != std::string_view::npos) {
      LineCounter{text_}.place_at(start, place);
    }
    refuse(place,
           "a document type declaration (<!DOCTYPE>); expected XML without one, because entities "
           "are never resolved");
  }

  InputError syntax_error() {
    const XML_Error code = XML_GetErrorCode(parser_.get());
    const Place place = here();
    const auto not_valid = [&](std::string_view what) {
      return error_at(place, fmt::format("not valid XML: {}", what));
    };
    const std::string inside =
        open_.empty() ? std::string{}
                      : fmt::format("<{}>, which begins at line {}, column {}", open_.back().name,
                                    open_.back().place.line, open_.back().place.column);
    if (trimmed(text_).empty() || text_ == utf8_mark) return error_at(place, "nothing in it");
    if (code == XML_ERROR_TAG_MISMATCH) return not_valid("the end tag is not that of " + inside);
    if (code == XML_ERROR_JUNK_AFTER_DOC_ELEMENT) {
      return not_valid("something follows the root element; expected only one");
    }
    if (code == XML_ERROR_UNDEFINED_ENTITY) return not_valid("an entity that nothing declares");
    if (!inside.empty() && offset() >= text_.size()) return not_valid("it ends inside " + inside);
    if (code == XML_ERROR_INVALID_TOKEN && offset() < text_.size()) {
      const auto byte = static_cast<unsigned char>(text_[offset()]);
      if (byte >= 0x80) return not_valid(fmt::format("byte 0x{:02x} is not valid UTF-8", byte));
      if (byte < 0x20) return not_valid(fmt::format("control character 0x{:02x}", byte));
    }
    return not_valid(XML_ErrorString(code));
  }

  std::string_view text_;
  const MendedXml* mended_;
  std::shared_ptr<const std::string> source_;
  LineCounter lines_;
  bool is_wide_;  ///< UTF-16: columns are characters
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser_;
  std::vector<XmlElement> open_;
  XmlElement root_;
  std::size_t elements_ = 0;
  std::optional<InputError> refused_;
};

}  // namespace

const XmlElement* XmlElement::find(std::string_view child) const {
  const auto found = std::ranges::find(children, child, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

const std::string* XmlElement::attribute(std::string_view name_of_it) const {
  const auto found = std::ranges::find(attributes, name_of_it, &XmlAttribute::name);
  return found == attributes.end() ? nullptr : &found->value;
}

Result<XmlElement> parse_xml(std::string_view text, const std::string& source) {
  if (text.size() > max_xml_bytes) {
    return InputError{source, fmt::format("longer than {} bytes", max_xml_bytes)};
  }
  return XmlBuilder{text, source}.parse();
}

Result<XmlDocument> parse_vendor_xml(std::string_view text, const std::string& source) {
  Result<XmlElement> strict = parse_xml(text, source);
  if (strict) return XmlDocument{{*std::move(strict)}};
  const MendedXml mended = text.size() > max_xml_bytes ? MendedXml{} : mend_xml(text);
  if (mended.oddities.empty()) return strict.error();
  Result<XmlElement> root = XmlBuilder{text, source, &mended}.parse();
  const bool ends = std::ranges::none_of(mended.oddities, [](const MendedXml::Found& one) {
    return one.oddity == XmlOddity::missing_end;
  });
  if (!root) return ends ? root.error() : strict.error();
  XmlDocument document;
  document.not_well_formed = strict.error();
  if (mended.is_wrapped) {
    document.roots = std::move(root->children);
  } else {
    document.roots.push_back(*std::move(root));
  }
  const auto name = std::make_shared<const std::string>(source);
  for (const auto& [oddity, offset] : mended.oddities) {
    Place place{name, 1, 1};
    LineCounter{text}.place_at(offset, place);
    document.oddities.push_back({oddity, place});
    if (document.oddities.size() == max_xml_oddities) break;
  }
  return document;
}

Result<XmlDocument> load_xml(const std::string& path) {
  const auto text = file_text(path, max_xml_bytes);
  if (!text) return text.error();
  return parse_vendor_xml(*text, path);
}

}  // namespace stormproof::model::config::vendor
