// The answer of `stormproof profile show`: every knob of a profile with its value, where that came
// from, and whether a user of the library could have another one; then what the profile says that
// is no knob. Nothing of a vendor's file is left out: what sets no knob is listed with its reason.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/config/distributions.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::report {

/// Who gave a knob its value.
enum class Giver : std::uint8_t {
  file,      ///< a user's YAML profile
  vendor,    ///< a vendor's XML file
  override,  ///< --set
  preset,    ///< a profile that is shipped with the program
  model      ///< nobody: the default of the model
};
[[nodiscard]] const char* name_of(Giver giver);

/// Where something that a profile says came from.
struct Origin {
  Giver giver = Giver::model;
  model::config::Place place;  ///< no source if `giver` is `model`
  std::string preset;          ///< name, if it is one
  std::string evidence;        ///< of a preset: the comment beside the value
  std::string element;         ///< of a vendor's file: path of the XML element
};

/// Whether a user of the vendor's library can choose a value.
struct Access {
  bool changeable = false;
  std::string setting;  ///< the XML element that sets it; empty if a user cannot
  std::string why;      ///< why not, or how the element's value relates to the knob's
};

struct KnobRow {
  std::string key;
  std::string value;  ///< as a file would say it
  Origin origin;
  std::optional<Access> access;  ///< absent: the profile describes no vendor's library
};

/// A setting of the described system that the model has not.
struct UnmodelledRow {
  std::string setting;
  std::string effect;
  Origin origin;
};

struct ProfileReport {
  std::string reference;  ///< as the user gave it
  std::string preset;     ///< that it builds on; empty: none
  /// The ROS 2 distribution by whose name it was given, or the base of a vendor's file.
  std::optional<model::config::Distribution> distribution;
  std::optional<model::config::vendor::Vendor> vendor;  ///< whose library it describes
  std::string selected;  ///< profile or domain of a vendor's file; empty: none, or it has no name
  std::string vendor_file;                ///< a vendor's file that it is or builds on; empty: none
  std::vector<KnobRow> knobs;             ///< in the order of the table
  std::vector<UnmodelledRow> unmodelled;  ///< in the order of their names
  /// Of a vendor's file, those that set no knob, in the order of the file.
  std::vector<model::config::vendor::Setting> others;
  std::size_t remarks = 0;  ///< of `profile lint`, warnings and errors
};

/// Reads the comments of shipped presets again, for their evidence.
[[nodiscard]] ProfileReport describe_profile(const model::config::TracedProfile& traced,
                                             const model::config::SpecPath& specs);

/// Knobs in a table, what sets no knob below it.
[[nodiscard]] Document document_of(const ProfileReport& report);

/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const ProfileReport& report);
[[nodiscard]] nlohmann::ordered_json profile_schema(SchemaDefinitions& definitions);

}  // namespace stormproof::report
