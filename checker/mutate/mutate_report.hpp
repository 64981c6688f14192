// The result of `stormproof mutate` as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "checker/mutate/mutate.hpp"

namespace stormproof::mutate {

[[nodiscard]] std::string to_text(const MutationReport& report);

/// Keys: mutants (id, description, killed_by, reason), killed, properties, seconds, interrupted.
[[nodiscard]] nlohmann::ordered_json to_json(const MutationReport& report);

}  // namespace stormproof::mutate
