// What one Cyclone DDS file sets for one domain, between the reading of its XML and the changes of
// the profile that follow from it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/vendor/cyclonedds_options.hpp"

namespace stormproof::model::config::vendor {

struct CycloneReading {
  const CycloneOption* option = nullptr;
  CycloneValue value;
  std::string shown;  ///< the value, spelled in one way: "100 ms", "spdp"
  Place place;
  std::size_t setting = 0;  ///< its place in `VendorProfile::settings`
};

/// One NetworkInterface, with what is set of it by itself.
struct CycloneInterface {
  Place place;
  std::optional<CycloneReading> multicast = {};        ///< [@multicast]
  std::optional<CycloneReading> allow_multicast = {};  ///< [@allow_multicast], of 11
};

/// On how many interfaces announcements go by multicast.
enum class Announcing : std::uint8_t { everywhere, somewhere, nowhere };

/// The last value of each setting, by its path.
class CycloneSettings {
 public:
  void add(CycloneReading reading);

  /// Null if the file does not set it.
  [[nodiscard]] const CycloneReading* find(std::string_view path) const;
  /// Its value, or the default.
  [[nodiscard]] CycloneValue value(std::string_view path) const;
  [[nodiscard]] std::string shown(std::string_view path) const;
  /// What AllowMulticast and the interfaces come to.
  [[nodiscard]] Announcing announcing() const;
  /// What switches multicast off, if announcements do not go by it everywhere: the setting of an
  /// interface, or AllowMulticast. Null otherwise.
  [[nodiscard]] const CycloneReading* silencer() const;
  /// "auto" or "none"; empty: a number. What `default` of 11 comes to, and where 0.10 has an
  /// interface without multicast.
  [[nodiscard]] std::string participant_index() const;
  /// So many ports of each peer are announced to, if all peers are hosts without a port; nothing:
  /// there are no peers, or some have one.
  [[nodiscard]] std::optional<std::int64_t> ports_of_peers() const;
  /// Processes of a host that find an index in this domain; nothing: all do.
  [[nodiscard]] std::optional<std::int64_t> participants_of_a_host() const;

  [[nodiscard]] const auto& all() const { return readings_; }

  CycloneVersion version = CycloneVersion::of_0_10;
  std::vector<CycloneReading> peers;         ///< every address
  std::vector<CycloneReading> prune_delays;  ///< of peers, of 11
  std::vector<CycloneInterface> interfaces;

 private:
  std::map<std::string_view, CycloneReading> readings_;
};

/// How a value is spelled in a report.
[[nodiscard]] std::string print_cyclone(const CycloneType& type, const CycloneValue& value);
[[nodiscard]] bool is_usual(const CycloneOption& option, const CycloneValue& value);

/// Puts `setting` into the `unmodelled` of `profile.changes`.
void assume(VendorProfile& profile, std::string_view setting, const Place& place, std::string text);

/// Writes `profile.changes` (without its `base`), corrects what `profile.settings` say about
/// settings whose effect depends on others, and adds remarks. An error: a value that the model
/// cannot take.
[[nodiscard]] std::optional<InputError> apply_cyclone_settings(const CycloneSettings& settings,
                                                               VendorProfile& profile);

/// The part of it that concerns multicast, transport and interfaces.
void apply_cyclone_network(const CycloneSettings& settings, VendorProfile& profile);

/// Adds remarks about settings that contradict each other or do nothing beside each other.
void look_for_contradictions(const CycloneSettings& settings, VendorProfile& profile);

}  // namespace stormproof::model::config::vendor
