// Records every composition once.
#include "fsm/composition/compositions.hpp"

#include <algorithm>

#include "fsm/composition/amended.hpp"
#include "fsm/composition/cyclone.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/fastdds_life.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/composition/recorder.hpp"
#include "fsm/composition/server.hpp"

namespace stormproof::fsm::composition {

std::string_view label(Owner owner) {
  if (owner == owner::participant) return "participant";
  if (owner == owner::pair) return "pair";
  if (owner == owner::writer) return "writer";
  if (owner == owner::relation) return "relation";
  if (owner == owner::entry) return "entry";
  if (owner == owner::descriptor) return "descriptor";
  return "control relation";
}

const std::vector<CompositionInfo>& compositions() {
  static const std::vector<CompositionInfo> all{
      recorded<paper::Paper>(),     recorded<fastdds::FastDds>(),
      recorded<cyclone::Cyclone>(), recorded<server::FastDdsServer>(),
      recorded<amended::Amended>(), recorded<fastdds::FastDdsLiving>()};
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
