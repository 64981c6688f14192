// What is known of a claim from the rules, for all losses: where an exhibit says that its repair is
// proved, the certificate is asked, and the search is held against it.
#pragma once

#include <functional>
#include <string_view>

#include "checker/experiments/museum/search.hpp"
#include "props/verdict.hpp"

namespace stormproof::museum {

/// Whether there are certificates of the claim.
[[nodiscard]] bool is_provable(std::string_view claim);

/// What a proof makes of what the search has found: a proof, or a dispute if a run breaks what is
/// proved.
void take(Found& found, const props::Finding& proof);

/// Takes the proof that the rules of the variant have, if they have one. A run that breaks only the
/// bound of the exhibit, not that of the catalogue, says nothing against it. `go_on` is asked now
/// and then.
void certify(Found& found, const Exhibit& exhibit, const Variant& variant,
             const std::function<bool()>& go_on);

}  // namespace stormproof::museum
