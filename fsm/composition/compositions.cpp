// The recorded programs in words.
#include "fsm/composition/compositions.hpp"

#include "fsm/program/programs.hpp"
#include "fsm/program/words.hpp"

namespace stormproof::fsm::composition {

const std::vector<CompositionInfo>& compositions() {
  static const std::vector<CompositionInfo> all = [] {
    std::vector<CompositionInfo> words;
    for (const program::Program& one : program::programs()) words.push_back(words_of(one));
    return words;
  }();
  return all;
}

std::map<EffectKey, std::string> effect_ids(const CompositionInfo& composition) {
  std::map<EffectKey, std::string> ids;
  for (const auto* list : {&composition.rules, &composition.procedures}) {
    for (const RuleInfo& rule : *list) {
      for (const EffectInfo& effect : rule.effects) ids.emplace(effect.key, effect.id);
    }
  }
  return ids;
}

}  // namespace stormproof::fsm::composition
