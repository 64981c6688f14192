// What a vendor's XML says about discovery, in the terms of this model: which knobs it sets, what
// it sets that no run of the model depends on, and what in it does not do what it seems to. A
// vendor's file becomes a profile like any other: a `base` (the preset of a version) with changes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/tree/tree.hpp"
#include "model/config/vendor/xml_text.hpp"

namespace stormproof::model::config::vendor {

enum class Vendor : std::uint8_t { fastdds, cyclonedds };

/// "Fast DDS", "Cyclone DDS".
[[nodiscard]] const char* name_of(Vendor vendor);

/// What a setting of the file does to discovery, and to its model.
enum class Effect : std::uint8_t {
  knob,        ///< it sets a knob of the model
  none,        ///< it has no effect on discovery (a setting of user endpoints, a name, a log)
  unmodelled,  ///< it acts on discovery in a way that the model has not: an assumption of every run
  outside,     ///< with it the system is not the one that the model describes (a discovery server,
               ///< static discovery): no run is possible
  unknown      ///< this version of the vendor's library has no such setting
};

[[nodiscard]] const char* name_of(Effect effect);

/// One element (or attribute) with a value, as it stands in the file.
struct Setting {
  std::string path;   ///< below the profile: "rtps/builtin/discovery_config/leaseAnnouncement"
  std::string value;  ///< as a person reads it: "3 s", "SIMPLE"
  Place place;
  Effect effect = Effect::none;
  std::string knob;  ///< key of the model ("spdp.period") if `effect` is `knob`
  std::string note;  ///< what it does, or why it does nothing; one sentence
};

enum class Severity : std::uint8_t {
  error,    ///< the vendor's library refuses the file, or the model cannot describe the system
  warning,  ///< it does not do what it seems to
  note      ///< worth knowing
};

[[nodiscard]] const char* name_of(Severity severity);

/// One remark of `profile lint`.
struct Remark {
  Severity severity = Severity::warning;
  std::string rule;  ///< stable id: "fastdds.writer-times", "cyclonedds.missing-unit"
  Place place;
  std::string message;  ///< what is there and what it does
  std::string hint;     ///< what to do instead; may be empty
};

/// A vendor's file, read.
struct VendorProfile {
  Vendor vendor{};
  std::string name;          ///< of the profile in the file that was read; may be empty
  std::string version_base;  ///< the preset that it changes: "fastdds-2.6.11"
  /// A profile as a YAML file would have it: `base`, the changed keys of `spdp` and `sedp` with the
  /// places of their XML, and `unmodelled`.
  Node changes;
  std::vector<Setting> settings;  ///< in the order of the file
  std::vector<Remark> remarks;    ///< in the order of the file
};

/// Which part of a file is meant, and on top of which preset.
struct Selection {
  std::string profile;  ///< name of a participant profile (Fast DDS) or id of a domain (Cyclone
                        ///< DDS); empty: the default one, or the only one
  std::string base;     ///< preset; empty: the one of the newest version that the vendor's XML
                        ///< default stands for (`default_base`)
};

/// "fastdds-2.6.11", "cyclonedds-0.10".
[[nodiscard]] std::string_view default_base(Vendor vendor);

/// Reads a document of either vendor, which its root element tells apart. Errors, with their
/// places: a root element of neither, a selected profile that is not there, several to choose from,
/// values that the vendor's library refuses (not a number, out of range, a missing unit), elements
/// that the model cannot take because of their value. An unknown element, and one with
/// `Effect::outside`, is no error here but a remark with `Severity::error`.
[[nodiscard]] Result<VendorProfile> read_vendor_profile(const XmlElement& root,
                                                        const Selection& selection);
/// The same of a text that may be odd: what the vendor's own parser takes is read, with a remark;
/// what it does not take is an error.
[[nodiscard]] Result<VendorProfile> read_vendor_profile(XmlDocument document,
                                                        const Selection& selection);

/// Of one vendor. `root` is `dds`, `profiles` or `participant` for Fast DDS, `CycloneDDS` for
/// Cyclone DDS. Fast DDS files are read as v2.6.11 reads them; a base of a later version
/// ("fastdds-2.14.5") also knows the elements that came until then.
[[nodiscard]] Result<VendorProfile> read_fastdds_profile(const XmlElement& root,
                                                         const Selection& selection);
[[nodiscard]] Result<VendorProfile> read_cyclonedds_profile(const XmlElement& root,
                                                            const Selection& selection);

/// The domains for which a Cyclone DDS file has settings of its own, without those for any; none of
/// another file.
[[nodiscard]] std::vector<std::string> domains_of(XmlDocument document);

/// The vendor whose library reads the document, or nothing.
[[nodiscard]] std::optional<Vendor> vendor_of(const XmlDocument& document);
/// The vendor whose files have this root element, or nothing.
[[nodiscard]] std::optional<Vendor> vendor_of(const XmlElement& root);

}  // namespace stormproof::model::config::vendor
