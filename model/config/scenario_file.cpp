// Reading is one pass in one direction, and each step takes what the one before it gives:
//
//   text      a file, by name or path            spec_path, vendor/reference, tree/file_text
//   tree      its values, each with its place    tree
//   resolved  overrides and profiles put in      resolve, profile_files, vendor
//   checked   the knob tables took the values    knobs
#include "model/config/scenario_file.hpp"

#include <fmt/core.h>

#include "model/config/knobs/knob_reader.hpp"
#include "model/config/resolve.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/config/vendor/reference.hpp"

namespace stormproof::model::config {
namespace {

/// The last step.
template <class Value>
Result<Traced<Value>> traced(const std::string& reference, Result<Resolved> resolved) {
  if (!resolved) return resolved.error();
  Result<Value> value = checked<Value>(resolved->tree);
  if (!value) return value.error();
  return Traced<Value>{reference, *std::move(value), places_of(resolved->tree),
                       std::move(resolved->preset), std::move(resolved->vendor)};
}

/// For those who want the value alone.
template <class Value>
Result<Value> untraced(Result<Traced<Value>> read) {
  if (!read) return read.error();
  return std::move(read->value);
}

Result<Traced<Scenario>> scenario_of(const std::string& reference, Result<Node> tree,
                                     std::span<const std::string> arguments,
                                     const SpecPath& specs) {
  if (!tree) return tree.error();
  const auto overrides = parse_overrides(arguments);
  if (!overrides) return overrides.error();
  return traced<Scenario>(
      reference,
      with_profile_keys(with_profiles(*std::move(tree), *overrides, specs), *overrides, specs));
}

template <class Profile>
Result<Traced<Profile>> profile_of(const std::string& reference, SpecKind kind,
                                   std::span<const std::string> arguments, const SpecPath& specs,
                                   Outside outside = Outside::refused) {
  const auto overrides = parse_overrides(arguments);
  if (!overrides) return overrides.error();
  const Place place{std::make_shared<const std::string>(reference)};
  Node name = Node::scalar(place, reference);
  return traced<Profile>(
      reference,
      with_keys(resolve_profile(std::move(name), kind, specs, outside), kind, *overrides, specs));
}

}  // namespace

Result<Traced<Scenario>> trace_scenario(const std::string& reference,
                                        std::span<const std::string> overrides,
                                        const SpecPath& specs) {
  if (vendor::parse_reference(reference)) {  // a natural mistake with a simple remedy
    return InputError{reference,
                      fmt::format("a DDS vendor's XML file is a profile; expected a scenario, "
                                  "which takes it with --set dds={}",
                                  reference)};
  }
  const auto file = specs.find(SpecKind::scenarios, reference, "", reference);
  if (!file) return file.error();
  return scenario_of(reference, load_yaml(*file), overrides, specs);
}

Result<Scenario> read_scenario(const std::string& reference, std::span<const std::string> overrides,
                               const SpecPath& specs) {
  return untraced(trace_scenario(reference, overrides, specs));
}

Result<Scenario> parse_scenario(std::string_view text, const std::string& source,
                                std::span<const std::string> overrides, const SpecPath& specs) {
  return untraced(scenario_of(source, parse_yaml(text, source), overrides, specs));
}

Result<TracedProfile> trace_dds_profile(const std::string& reference,
                                        std::span<const std::string> overrides,
                                        const SpecPath& specs, Outside outside) {
  return profile_of<DdsProfile>(reference, SpecKind::dds, overrides, specs, outside);
}

Result<DdsProfile> read_dds_profile(const std::string& reference,
                                    std::span<const std::string> overrides, const SpecPath& specs) {
  return untraced(trace_dds_profile(reference, overrides, specs));
}

Result<WirelessProfile> read_wireless_profile(const std::string& reference,
                                              std::span<const std::string> overrides,
                                              const SpecPath& specs) {
  return untraced(profile_of<WirelessProfile>(reference, SpecKind::wireless, overrides, specs));
}

}  // namespace stormproof::model::config
