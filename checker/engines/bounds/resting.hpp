// Findings that rest on others: a theorem that takes something from a certificate about the rules,
// and a certificate that several properties take something from.
#pragma once

#include <functional>
#include <string>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::checker {

/// Turns a finding into one without an answer, unless it is disputed.
void leave_open(props::Finding& finding, const std::string& why);

/// Adds what a theorem takes from a certificate about the rules: its assumptions, and how it is
/// known. Without that certificate there is no proof.
void rest_on(props::Finding& finding, const props::Finding& certificate);

/// What `decide` finds, which is asked once in a check.
[[nodiscard]] props::Finding known(const CheckRequest& request, const std::string& name,
                                   const std::function<props::Finding()>& decide);

}  // namespace stormproof::checker
