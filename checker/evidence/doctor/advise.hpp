// What to change: the model of the captured deployment is tuned, and its best settings become
// advice. Which profile and which channel describe the system is chosen by what the capture shows:
// the profiles that conform, or those of the version seen, and of the shipped channels the one over
// which the model comes nearest to what was observed.
#pragma once

#include "checker/evidence/doctor/doctor.hpp"

namespace stormproof::doctor {

/// The shipped profiles of the vendor and version of most participants.
[[nodiscard]] std::vector<std::string> profiles_of(const Product& product);

/// Fills `presets`: which of `profiles` explain every message.
void find_presets(const std::vector<std::string>& profiles, const Request& request, Report& report);

/// The file with which participants of the captured version do not look up types; empty if it does
/// not.
[[nodiscard]] std::string without_lookups(const std::vector<std::string>& profiles,
                                          const Report& report);

/// Fills `basis` and `advice`, or `no_advice`.
[[nodiscard]] std::optional<model::config::InputError> advise(
    const std::vector<std::string>& profiles, const Request& request, Report& report);

}  // namespace stormproof::doctor
