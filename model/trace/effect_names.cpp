// Looks ids up in the recorded composition.
#include "model/trace/effect_names.hpp"

#include "fsm/composition/compositions.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"

namespace stormproof::model::trace {

EffectNames::EffectNames(const DdsProfile& dds)
    : ids_{fsm::composition::effect_ids(composition_of(dds))} {
  // With a life its rules are those of another composition, which shares most of them.
  if (traits_of(dds).has_living_composition) {
    ids_.merge(fsm::composition::effect_ids(living_composition_of(dds)));
  }
  if (!traits_of(dds).has_server) return;
  // Descriptors on their way to the server go by the rules of Fast DDS.
  ids_.merge(fsm::composition::effect_ids(composition_of(dds.implementation)));
  DdsProfile alone = dds;
  alone.discovery = Discovery::simple;
  ids_.merge(fsm::composition::effect_ids(living_composition_of(alone)));
}

std::string_view EffectNames::take_starter(std::uint64_t insertion) {
  const auto found = timers_.find(insertion);
  if (found == timers_.end()) return {};
  const std::string_view starter = found->second;
  timers_.erase(found);
  return starter;
}

}  // namespace stormproof::model::trace
