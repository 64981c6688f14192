// Counterexamples without what they do not need: a reader of one asks of each participant,
// endpoint, loss and late packet what it has to do with the violation. Without this some are left
// from the search that found it, though the property breaks as early without them.
#pragma once

#include <functional>

#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// The same property, broken by the same rules no later than in `found`, where no participant,
/// endpoint, loss or delay can be left out by itself, unless the effort is spent before. `found` is
/// a counterexample. `goes_on` (may be empty) is asked now and then; false ends the search.
[[nodiscard]] props::Counterexample minimal(props::Counterexample found,
                                            const std::function<bool()>& goes_on = {});

}  // namespace stormproof::counterexample
