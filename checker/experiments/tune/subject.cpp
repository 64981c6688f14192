// The reader of scenarios says which preset the DDS profile was built on; the rest follows from its
// name.
#include "checker/experiments/tune/subject.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "props/applicability.hpp"

namespace stormproof::tune {

using model::config::InputError;
using model::config::Result;
using model::config::SpecKind;
using model::config::SpecPath;
namespace vendor = model::config::vendor;

namespace {

std::vector<std::string> products(const SpecPath& specs) {
  std::vector<std::string> names;
  for (const std::string& name : specs.names(SpecKind::dds)) {
    if (vendor::vendor_of_preset(name) && version_of(name) == name) names.push_back(name);
  }
  return names;
}

}  // namespace

std::string version_of(const std::string& preset) {
  for (std::size_t k = preset.find('-'); k != std::string::npos; k = preset.find('-', k + 1)) {
    const bool is_version = k + 1 < preset.size() && preset[k + 1] >= '0' && preset[k + 1] <= '9';
    if (is_version) return preset.substr(0, preset.find('-', k + 1));
  }
  return preset;
}

Result<Subject> read_subject(const std::string& reference, std::span<const std::string> overrides,
                             const std::string& preset, const SpecPath& specs) {
  std::vector<std::string> changes{overrides.begin(), overrides.end()};
  if (!preset.empty()) changes.push_back("dds=" + preset);
  auto traced = model::config::trace_scenario(reference, changes, specs);
  if (!traced) {
    InputError error = traced.error();
    if (!preset.empty() && error.where == "--set dds=" + preset) error.where = "--preset " + preset;
    return error;
  }
  if (const auto why = props::why_profile_is_not_changed(traced->value); !why.empty()) {
    return InputError{reference, std::string{why}};
  }
  const std::string& name = traced->preset;

  Subject subject;
  subject.preset = version_of(name);
  const auto whose = vendor::vendor_of_preset(subject.preset);
  if (!whose) {
    return InputError{reference,
                      fmt::format("its DDS profile{} is that of no product, so there is nothing "
                                  "that a user could set; tune a library with --preset: {}",
                                  name.empty() ? "" : fmt::format(" '{}'", name),
                                  fmt::join(products(specs), ", "))};
  }
  subject.vendor = *whose;
  const auto base = model::config::read_dds_profile(subject.preset, {}, specs);
  if (!base) return base.error();
  subject.base = *base;
  subject.scenario = std::move(traced->value);
  if (subject.base.implementation != subject.scenario.dds.implementation) {
    return InputError{reference, fmt::format("its DDS profile '{}' has another implementation than "
                                             "{}; expected one that is built on it, or --preset",
                                             name, subject.preset)};
  }
  return subject;
}

}  // namespace stormproof::tune
