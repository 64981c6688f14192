// Which DDS profiles may be in one run: those of one implementation that discover the same way, and
// that are no models of which versions are not described.
// Source: specs/guide/profiles.md, "Several profiles in one run".
#pragma once

#include <string>

#include <fmt/core.h>

#include "model/config/knobs/knobs.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::config {

/// What a participant's own profile would have to be, if it cannot run beside the scenario's.
[[nodiscard]] inline std::string expected_beside(const DdsProfile& whole, const DdsProfile& own) {
  const ImplementationTraits& traits = traits_of(whole);
  if (!traits.vendor) {
    return fmt::format(
        "none: only versions of Fast DDS, or of Cyclone DDS, run beside each other; "
        "{} has one profile for all",
        traits.whose);
  }
  if (whole.implementation != own.implementation) {
    return fmt::format(
        "a profile of {}, as the scenario's is: what {} and {} make of each other "
        "nobody has stated",
        traits.whose, traits.whose, traits_of(own).whose);
  }
  if (traits.has_server || traits_of(own).has_server) {
    return "none: a Discovery Server and its clients have one profile here";
  }
  if (whole.discovery != own.discovery) {
    return "a profile that discovers as the scenario's does";
  }
  if (whole.version.typelookup_unit != own.version.typelookup_unit) {
    return "the typelookup_unit of the scenario's profile";
  }
  return {};
}

void visit_mixed(auto& visit, Is<Scenario> auto& scenario) {
  const auto& participants = scenario.deployment.participants;
  for (std::size_t k = 0; k < participants.size(); ++k) {
    if (!participants[k].dds || *participants[k].dds == scenario.dds) continue;
    const std::string expected = expected_beside(scenario.dds, *participants[k].dds);
    if (expected.empty()) continue;
    return visit.rule(false, fmt::format("deployment.participants.{}.dds", k), expected);
  }
}

}  // namespace stormproof::model::config
