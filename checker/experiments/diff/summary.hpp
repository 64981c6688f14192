// The judgment of a whole comparison: the worst of its parts, and every reason for it.
#pragma once

#include <string>

#include "checker/experiments/diff/diff.hpp"

namespace stormproof::diff {

/// Fills `judgment` and `reasons` from the parts. An interrupted comparison is at best unclear.
void summarize(DiffReport& report);

/// "NO REGRESSION", "REGRESSION" or "INCONCLUSIVE".
[[nodiscard]] const char* headline(const DiffReport& report);

/// One or two sentences after it, in plain words.
[[nodiscard]] std::string headline_sentence(const DiffReport& report);

}  // namespace stormproof::diff
