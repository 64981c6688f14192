// The ending ".xml" is what tells a vendor's file from a name: the last one that is followed by the
// end, by '#' or by '@'. A '#' or '@' before it belongs to the file's name.
#include "model/config/vendor/reference.hpp"

#include <string_view>

#include "model/config/vendor/any_case.hpp"

namespace stormproof::model::config::vendor {
namespace {

constexpr std::string_view ending = ".xml";

/// Length of the file's name, or 0 if there is no XML file.
std::size_t file_length(std::string_view reference) {
  for (std::size_t end = reference.size(); end > ending.size(); --end) {
    const bool ends = end == reference.size() || reference[end] == '#' || reference[end] == '@';
    if (ends && is_same_word(reference.substr(end - ending.size(), ending.size()), ending)) {
      return end;
    }
  }
  return 0;
}

}  // namespace

std::optional<FileReference> parse_reference(const std::string& reference) {
  const bool is_inline = reference.starts_with('<') && reference.find('>') != std::string::npos;
  const std::size_t length = is_inline ? reference.rfind('>') + 1 : file_length(reference);
  if (length == 0) return std::nullopt;
  FileReference parts;
  (is_inline ? parts.text : parts.file) = reference.substr(0, length);
  constexpr std::string_view scheme = "file://";  // as in CYCLONEDDS_URI
  if (parts.file.starts_with(scheme)) parts.file.erase(0, scheme.size());
  std::string rest = reference.substr(length);
  if (const std::size_t at = rest.rfind('@'); at != std::string::npos) {
    parts.selection.base = rest.substr(at + 1);
    rest.erase(at);
  }
  if (rest.starts_with('#')) parts.selection.profile = rest.substr(1);
  return parts;
}

}  // namespace stormproof::model::config::vendor
