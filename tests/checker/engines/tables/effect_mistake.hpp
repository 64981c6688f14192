// A mistake at an effect of a composition, found by its rule and its words.
#pragma once

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "checker/engines/bounds/check_request.hpp"
#include "model/composition_of.hpp"

namespace stormproof::tables {

/// A mistake at the effect of this kind on this target in a rule or procedure.
inline checker::Mutant at_effect(const model::Scenario& scenario, std::string_view rule,
                                 std::string_view what,
                                 fsm::composition::EffectMutation::Change change) {
  checker::Mutant mutant;
  for (const fsm::composition::EffectMutation& mutation :
       fsm::composition::effect_mutations(model::composition_of(scenario.dds))) {
    if (mutation.change != change || !mutation.what.starts_with(what)) continue;
    if (!mutation.effect.starts_with(std::string{rule} + ".")) continue;
    mutant.rules.effects.push_back(mutation);
    break;
  }
  EXPECT_FALSE(mutant.rules.effects.empty()) << rule << ": " << what;
  return mutant;
}

}  // namespace stormproof::tables
