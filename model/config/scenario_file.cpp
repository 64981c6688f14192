// The last step of reading: the knob tables read the resolved tree.
#include "model/config/scenario_file.hpp"

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/resolve.hpp"

namespace stormproof::model::config {
namespace {

template <class Value>
Result<Value> read_tree(const Result<Node>& root) {
  if (!root) return root.error();
  Value value;
  std::optional<InputError> failure;
  read_knobs(*root, "", value, failure);
  if (failure) return *std::move(failure);
  return value;
}

}  // namespace

Result<Scenario> parse_scenario(std::string_view text, const std::string& source,
                                std::span<const std::string> overrides, const SpecPath& specs) {
  return read_tree<Scenario>(resolve_scenario_text(text, source, overrides, specs));
}

Result<Scenario> read_scenario(const std::string& reference, std::span<const std::string> overrides,
                               const SpecPath& specs) {
  return read_tree<Scenario>(resolve_scenario(reference, overrides, specs));
}

Result<DdsProfile> read_dds_profile(const std::string& reference,
                                    std::span<const std::string> overrides, const SpecPath& specs) {
  return read_tree<DdsProfile>(resolve_profile(reference, SpecKind::dds, overrides, specs));
}

Result<WirelessProfile> read_wireless_profile(const std::string& reference,
                                              std::span<const std::string> overrides,
                                              const SpecPath& specs) {
  return read_tree<WirelessProfile>(
      resolve_profile(reference, SpecKind::wireless, overrides, specs));
}

}  // namespace stormproof::model::config
