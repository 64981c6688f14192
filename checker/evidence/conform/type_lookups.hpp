// Whether questions about types and their answers have a cause, as far as their contents show it
// (specs/guide/fastdds.md, "Lookups of types"): who asks has been told of an endpoint with the type
// and has none itself, asks for it once for each stream, and for the type itself after the answer
// about its dependencies; who answers was asked, and answers once. Between two hosts everything is
// in the capture; of what participants of one host ask each other only what follows from it.
#pragma once

#include <vector>

#include "checker/evidence/conform/context.hpp"

namespace stormproof::conform {

/// The first of each writer.
[[nodiscard]] std::vector<Unexplained> faults_of_lookups(const Context& its);

}  // namespace stormproof::conform
