// The result of `stormproof mutate` as a document and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "checker/verification/mutate/mutate.hpp"

namespace stormproof::mutate {

/// Who notices which mutant, and how many each property and each law notices.
[[nodiscard]] report::Document document_of(const MutationReport& report);

/// Keys: everybody, mutants (id, kind, description, killed_by, reason, killed_by_laws,
/// makes_a_difference, harm), killed, unseen, only_followed, seen_at_effects, noticed_in_rules,
/// shares (composition, seen, noticed_in_rules, suffices), killed_by_property, killed_by_any_law,
/// tried_on_laws, killed_by_law, seconds.
[[nodiscard]] nlohmann::ordered_json to_json(const MutationReport& report);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::mutate
