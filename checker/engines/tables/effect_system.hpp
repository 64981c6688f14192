// The transition system of one generic descriptor in which each effect of the composition leaves a
// mark when it happens, and knobs are unknowns: what `composition.live` asks its questions to. It
// has all rules, also those that announce and those of control-only relations, and what opens a
// relation only happens once it is raised.
#pragma once

#include <functional>

#include "checker/engines/tables/derivation.hpp"
#include "fsm/composition/composition_info.hpp"
#include "model/dds_profile.hpp"
#include "model/mutation.hpp"

namespace stormproof::tables {

/// A switch or delay of a composition, and what it is in a profile.
struct Knob {
  std::string name;
  std::function<Expr(const model::DdsProfile&)> value;
};

struct EffectSystem {
  std::vector<std::string> effects;  ///< their ids (EffectInfo::id), in the order of the page
  /// Its first variables are the marks, in the order of `effects`. Knobs are constants that are no
  /// variables.
  TransitionSystem system;
  std::vector<Knob> knobs;
  Exprs unknowns;  ///< what stands for the knobs in `system`
};

/// With the mistakes of a mutant. Throws std::out_of_range if the derivation has an effect that
/// `recorded` has not.
[[nodiscard]] EffectSystem effect_system(const model::DdsProfile& dds,
                                         const model::Mutation& mistakes,
                                         const fsm::composition::CompositionInfo& recorded);

/// "effect AckNackArrives.3", the mark of that one.
[[nodiscard]] std::string mark_of(const std::string& effect);

/// The system under these knobs: all, or those for which `fixed` is true.
[[nodiscard]] TransitionSystem under(const EffectSystem& effects, const model::DdsProfile& dds,
                                     const std::vector<bool>& fixed);

}  // namespace stormproof::tables
