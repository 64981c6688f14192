// What of the readers of files stands behind model/config in the page: its own YAML in the place of
// yaml-cpp's, and no XML, which the command line reads with Expat.
#include <fmt/format.h>

#include "checker/page/plain_yaml.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/config/vendor/vendor_profile.hpp"
#include "model/config/vendor/xml_text.hpp"

namespace stormproof::model::config {

Result<Node> parse_yaml(std::string_view text, const std::string& source) {
  if (text.size() > max_file_bytes) {
    return InputError{source, fmt::format("longer than {} bytes", max_file_bytes)};
  }
  return page::parse_plain_yaml(text, source);
}

namespace vendor {

namespace {

InputError no_xml(const std::string& where) {
  return {where,
          "a vendor's XML file; this page reads YAML: expected the name of a profile, or a map "
          "with its keys, as `stormproof profile show FILE.xml` prints it"};
}

}  // namespace

Result<XmlDocument> load_xml(const std::string& path) { return no_xml(path); }
Result<XmlDocument> parse_vendor_xml(std::string_view, const std::string& source) {
  return no_xml(source);
}
// Without a document nobody asks for what is in one.
Result<VendorProfile> read_vendor_profile(XmlDocument, const Selection&) { return no_xml({}); }
std::optional<Vendor> vendor_of(const XmlDocument&) { return std::nullopt; }
std::optional<Vendor> vendor_of_preset(std::string_view) { return std::nullopt; }
const char* name_of(Vendor vendor) {
  return vendor == Vendor::fastdds ? "Fast DDS" : "Cyclone DDS";
}

}  // namespace vendor
}  // namespace stormproof::model::config
