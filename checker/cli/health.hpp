// The exit code for the health of a captured discovery.
#pragma once

#include "checker/cli/exit_code.hpp"
#include "checker/evidence/doctor/doctor.hpp"

namespace stormproof::cli {

[[nodiscard]] constexpr ExitCode exit_code_of(doctor::Health health) {
  switch (health) {
    case doctor::Health::healthy:
      return established;
    case doctor::Health::storm:
    case doctor::Health::incomplete:
    case doctor::Health::unmatched:
      return violated;
    case doctor::Health::unknown:
      break;
  }
  return inconclusive;
}

}  // namespace stormproof::cli
