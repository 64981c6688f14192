// What CI systems see of a check.
#pragma once

#include "checker/verification/check/check_report.hpp"

namespace stormproof::checker {

/// A property: violated is a failure, inconclusive nobody knows.
[[nodiscard]] report::Finding ci_finding(const PropertyResult& result, Standing standing,
                                         const CheckContext& context);

/// That this deployment is in a storm, or does not complete.
[[nodiscard]] report::Finding outlook_finding(const CheckReport& report,
                                              const CheckContext& context);

}  // namespace stormproof::checker
