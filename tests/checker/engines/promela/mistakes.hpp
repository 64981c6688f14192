// Mistakes in tables, and at effects by the name of the effect.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "fsm/composition/compositions.hpp"
#include "model/mutation.hpp"

namespace stormproof::promela {

using Change = fsm::composition::EffectMutation::Change;

inline model::Mutation in_tables(std::vector<fsm::TableMutation> tables) {
  model::Mutation mistakes;
  mistakes.tables = std::move(tables);
  return mistakes;
}
/// No mistake at all if there is none of this name.
inline model::Mutation at_effect(std::string_view composition, std::string_view effect,
                                 Change change) {
  model::Mutation mistakes;
  for (const auto& info : fsm::composition::compositions()) {
    if (info.name != composition) continue;
    for (const auto& mistake : fsm::composition::effect_mutations(info)) {
      if (mistake.effect == effect && mistake.change == change) mistakes.effects.push_back(mistake);
    }
  }
  return mistakes;
}

}  // namespace stormproof::promela
