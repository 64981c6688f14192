// What the elements of a Fast DDS profile mean for discovery, once they are read: the knobs that
// they set, and the remarks about what does not do what it seems to.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/vendor/fastdds_section.hpp"

namespace stormproof::model::config::vendor::fastdds {

/// A transport descriptor of the file.
struct Transport {
  std::string id;
  std::string type;  ///< "UDPv4", …
  const XmlElement* element = nullptr;
  Section section;
  bool is_used = false;   ///< by the participant that was selected
  bool is_named = false;  ///< in the <userTransports> of any participant
};

[[nodiscard]] inline bool is_udp(const Transport& transport) {
  return transport.type.starts_with("UDP");
}

/// What the parts of the reading share.
struct Reading {
  Version version = oldest_version;
  VendorProfile profile;
  const XmlElement* root = nullptr;         ///< of the file
  const XmlElement* participant = nullptr;  ///< that was selected; null: the file has none
  Section section;                          ///< of it
  std::vector<Transport> transports;        ///< all of the file, each id once
  std::map<std::string, std::size_t> transport_of_id = {};  ///< index in `transports`

  [[nodiscard]] Setting& setting_of(const Found& found) { return profile.settings[found.setting]; }
};

/// The elements in which profiles stand: <profiles>, and <dds> itself.
[[nodiscard]] std::vector<const XmlElement*> containers_of(const XmlElement& root);
/// Those in the first <profiles>; the library keeps no others.
[[nodiscard]] std::vector<const XmlElement*> participants_of(const XmlElement& root);
/// Empty if it has none.
[[nodiscard]] std::string name_of_profile(const XmlElement& participant);
/// The participant that is meant; null if the file has none and none was asked for.
[[nodiscard]] const XmlElement* select_participant(const XmlElement& root,
                                                   const std::string& wanted);
/// Elements that may not stand in <dds> or <profiles>.
void remark_containers(Reading& reading);
/// What makes the library refuse the file because of participants that were not selected.
void check_other_participants(Reading& reading, const SectionRules& rules);
/// What is wrong with the choice between the participants.
void remark_participants(Reading& reading);

/// Puts a value into `changes` ("spdp", "period") and makes the setting that of this knob.
void set_knob(Reading& reading, const Found& found, std::string_view section, std::string_view key,
              std::string value);
/// The setting does nothing to discovery, for the reason in `note`.
void set_inert(Reading& reading, const Found& found, std::string note);
/// With this setting no run is possible; one remark says so.
void set_outside(Reading& reading, const Found& found, std::string note);

/// Announcements, leases and the discovery protocol.
void interpret_announcements(Reading& reading);
/// Discovery servers, static discovery, peers, throughput controller and properties.
void interpret_participant(Reading& reading);
/// Which transports are used, and what that means.
void interpret_transports(Reading& reading);
/// The threshold of the piggyback HEARTBEAT and the largest message, of the transports in use.
void interpret_sizes(Reading& reading, bool builtin_udp);
/// Profiles of user endpoints: what is in them does not act on SEDP.
void remark_endpoints(Reading& reading, const XmlElement& profiles);

}  // namespace stormproof::model::config::vendor::fastdds
