// Profiles of user endpoints. Their timers, modes and controllers look like those of SEDP, whose
// writers and readers have constants instead (EDPSimple.cpp:54-57), so each gets a remark.
#include <array>

#include <fmt/core.h>

#include "model/config/vendor/fastdds_discovery.hpp"

namespace stormproof::model::config::vendor::fastdds {
namespace {

constexpr std::string_view constants =
    "those of SEDP are constants of the library: HEARTBEAT period, NACK response, suppression and "
    "HEARTBEAT response cannot be set";

/// The first element of this name anywhere below `element`, or null.
const XmlElement* find_below(const XmlElement& element, std::string_view name) {
  for (const XmlElement& child : element.children) {
    if (child.name == name) return &child;
    if (const XmlElement* found = find_below(child, name)) return found;
  }
  return nullptr;
}

void remark_section(Reading& reading, const XmlElement& endpoint, bool is_writer) {
  VendorProfile& profile = reading.profile;
  if (const XmlElement* times = endpoint.find("times")) {
    add_remark(profile, Severity::warning,
               is_writer ? "fastdds.writer-times" : "fastdds.reader-times", times->place,
               fmt::format("<times> of a {} act on user topics only, not on SEDP", endpoint.name),
               std::string{constants});
  }
  if (const XmlElement* controller = endpoint.find("throughputController")) {
    add_remark(profile, Severity::warning, "fastdds.throughput-controller", controller->place,
               "a throughput controller does not pace SEDP");
  }
  if (const XmlElement* piggyback = find_below(endpoint, "disable_heartbeat_piggyback")) {
    add_remark(profile, Severity::warning, "fastdds.heartbeat-piggyback", piggyback->place,
               "<disable_heartbeat_piggyback> acts on user topics only; SEDP keeps its piggyback "
               "HEARTBEATs",
               "their threshold is the least send buffer of the transports");
  }
  if (const XmlElement* mode = find_below(endpoint, "publishMode")) {
    add_remark(profile, Severity::note, "fastdds.publish-mode", mode->place,
               "<publishMode> acts on user topics only; the writers of SEDP are synchronous");
  }
  const XmlElement* policy = endpoint.find("propertiesPolicy");
  const XmlElement* list = policy == nullptr ? nullptr : policy->find("properties");
  if (list == nullptr) return;
  for (const XmlElement& property : list->children) {
    const XmlElement* name = property.find("name");
    if (name == nullptr || name->text != "fastdds.push_mode") continue;
    add_remark(profile, Severity::warning, "fastdds.push-mode", property.place,
               "fastdds.push_mode acts on this writer only, not on SEDP");
  }
}

}  // namespace

void remark_endpoints(Reading& reading, const XmlElement& profiles) {
  for (const XmlElement& endpoint : profiles.children) {
    const bool is_writer = endpoint.name == "data_writer" || endpoint.name == "publisher";
    const bool is_reader = endpoint.name == "data_reader" || endpoint.name == "subscriber";
    if (!is_writer && !is_reader) continue;
    const std::string* name = endpoint.attribute("profile_name");
    const SectionRules rules{
        .schema = is_writer ? writer_schema() : reader_schema(),
        .version = reading.version,
        .prefix = fmt::format("{}[{}]/", endpoint.name, name == nullptr ? std::string{} : *name)};
    const Section section = read_section(endpoint, rules, reading.profile);
    for (const Found& found : section.found) {
      set_inert(reading, found, "acts on endpoints of user topics only, not on SEDP");
    }
    remark_section(reading, endpoint, is_writer);
  }
}

}  // namespace stormproof::model::config::vendor::fastdds
