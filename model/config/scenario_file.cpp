// Reading is one pass in one direction: text to tree (model/config/tree), overrides and profiles
// put in (resolve.cpp), values checked (model/config/knobs). provenance.cpp is the same pass for
// those who also want the places.
#include "model/config/scenario_file.hpp"

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/resolve.hpp"

namespace stormproof::model::config {

Result<Scenario> parse_scenario(std::string_view text, const std::string& source,
                                std::span<const std::string> overrides, const SpecPath& specs) {
  return checked<Scenario>(resolve_scenario_text(text, source, overrides, specs));
}

Result<Scenario> read_scenario(const std::string& reference, std::span<const std::string> overrides,
                               const SpecPath& specs) {
  return checked<Scenario>(resolve_scenario(reference, overrides, specs));
}

Result<DdsProfile> read_dds_profile(const std::string& reference,
                                    std::span<const std::string> overrides, const SpecPath& specs) {
  return checked<DdsProfile>(resolve_profile(reference, SpecKind::dds, overrides, specs));
}

Result<WirelessProfile> read_wireless_profile(const std::string& reference,
                                              std::span<const std::string> overrides,
                                              const SpecPath& specs) {
  return checked<WirelessProfile>(resolve_profile(reference, SpecKind::wireless, overrides, specs));
}

}  // namespace stormproof::model::config
