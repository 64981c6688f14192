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

/// Fills `without_lookups`, if participants of the captured version look up types, and `basis`, if
/// the model predicts the capture.
void switch_lookups_off(const std::vector<std::string>& profiles, const Request& request,
                        Report& report);

/// Fills `basis` and `advice`, or `no_advice`.
[[nodiscard]] std::optional<model::config::InputError> advise(
    const std::vector<std::string>& profiles, const Request& request, Report& report);

}  // namespace stormproof::doctor
