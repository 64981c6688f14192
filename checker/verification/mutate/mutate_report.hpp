// The result of `stormproof mutate` as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "checker/verification/mutate/mutate.hpp"

namespace stormproof::mutate {

[[nodiscard]] std::string to_text(const MutationReport& report);

/// Keys: mutants (id, description, killed_by, reason, killed_by_laws), killed, properties,
/// killed_by_laws, tried_on_laws, laws, seconds, interrupted.
[[nodiscard]] nlohmann::ordered_json to_json(const MutationReport& report);

}  // namespace stormproof::mutate
