// Effects whose marks never change under the profile, and why.
#include "checker/engines/tables/impossible_effects.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/excluded_effects.hpp"
#include "checker/engines/tables/ruled_out.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {

std::vector<ImpossibleEffects> impossible_effects(const model::DdsProfile& dds) {
  if (model::traits_of(dds).has_server) {
    // Nothing is derived from what a server adds; descriptors on their way to it go by the rules of
    // Fast DDS.
    model::DdsProfile simple = dds;
    simple.discovery = model::Discovery::simple;
    std::vector<ImpossibleEffects> all = impossible_effects(simple);
    std::ranges::move(excluded_effects(dds), std::back_inserter(all));
    all.push_back(effects_between_servers(dds));
    return all;
  }
  // Engines do not execute the rules of Cyclone DDS.
  if (model::traits_of(dds).writer == model::Writer::of_cyclone) return {};
  model::Scenario scenario;
  scenario.dds = dds;
  smt::Claims claims;
  const checker::CheckRequest request{scenario, claims, nullptr, 0, 1, {}};
  Proof proof{"composition.live", request};
  const EffectSystem effects = effect_system(dds, proof.mistakes(), model::composition_of(dds));
  std::vector<bool> never =
      never_changing(under(effects, dds, std::vector<bool>(effects.knobs.size(), true)));
  never.resize(effects.effects.size());
  std::vector<ImpossibleEffects> all;
  for (const RuledOut& group : why_ruled_out(proof, effects, never)) {
    if (group.by.empty()) continue;
    ImpossibleEffects& named = all.emplace_back();
    named.by = group.by;
    for (const std::size_t effect : group.effects) named.effects.push_back(effects.effects[effect]);
  }
  if (proof.finish("").kind != props::VerdictKind::proved) return {};
  return all;
}

}  // namespace stormproof::tables
