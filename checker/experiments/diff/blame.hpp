// Which knob of a change makes it regress: the candidate again, with single knobs set back.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "checker/experiments/diff/costs.hpp"

namespace stormproof::diff {

/// `candidate` with `keys` as `base` has them. Nothing if that is no valid profile, or if the
/// profiles have different implementations: their knobs are not the same ones.
[[nodiscard]] std::optional<model::DdsProfile> with_reverted(const model::DdsProfile& candidate,
                                                             const model::DdsProfile& base,
                                                             const std::vector<std::string>& keys);

/// Takes the configuration that regresses most, and sets back each changed knob that matters; if
/// none of them cures it, pairs of them. Nothing if no configuration regresses, if there is only
/// one such knob, or if it was interrupted.
[[nodiscard]] std::optional<Blame> blame(const std::vector<KnobChange>& changes,
                                         const CostRequest& request, const CostAnswer& costs);

}  // namespace stormproof::diff
