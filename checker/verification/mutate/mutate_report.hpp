// The result of `stormproof mutate` as a document and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/verification/mutate/mutate.hpp"

namespace stormproof::mutate {

/// Who notices which mutant, and how many each property and each law notices.
[[nodiscard]] report::Document document_of(const MutationReport& report);

/// Keys: mutants (id, kind, description, killed_by, reason, killed_by_laws, makes_a_difference),
/// killed, harmless, properties, killed_by_laws, tried_on_laws, laws, seconds, interrupted.
[[nodiscard]] nlohmann::ordered_json to_json(const MutationReport& report);

}  // namespace stormproof::mutate
