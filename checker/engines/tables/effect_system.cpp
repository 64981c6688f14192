// Derives all rules with marks.
#include "checker/engines/tables/effect_system.hpp"

#include <algorithm>

#include "checker/engines/tables/derived.hpp"
#include "model/composition_of.hpp"

namespace stormproof::tables {

EffectSystem effect_system(const model::DdsProfile& dds, const model::Mutation& mistakes,
                           const fsm::composition::CompositionInfo& recorded) {
  EffectSystem result{
      {},
      {{}, Expr{smt::SymbolicContext::current()}, {}, Expr{smt::SymbolicContext::current()}},
      {},
      {}};
  Derivation derivation{Unsound::none};
  for (const auto* rules : {&recorded.rules, &recorded.procedures, &recorded.steps}) {
    for (const fsm::composition::RuleInfo& rule : *rules) {
      for (const fsm::composition::EffectInfo& effect : rule.effects) {
        result.effects.push_back(effect.id);
        derivation.declare(mark_of(effect.id), false);
      }
    }
  }
  const Expr yes = smt::SymbolicContext::current().bool_val(true);
  Derived derived{dds, mistakes, derivation};
  derived.happens = [&](const std::string& effect, const Expr& when) {
    derivation.assign(mark_of(effect), when, yes);
  };
  derived.knob = [&](const Knob& knob) {
    const auto known = std::ranges::find(result.knobs, knob.name, &Knob::name);
    if (known != result.knobs.end()) {
      return result.unknowns[static_cast<std::size_t>(known - result.knobs.begin())];
    }
    z3::context& context = smt::SymbolicContext::current();
    result.unknowns.push_back(
        context.constant(("knob " + knob.name).c_str(), knob.value(dds).get_sort()));
    result.knobs.push_back(knob);
    return result.unknowns.back();
  };
  derive(model::program_of_exchange(dds), derived);
  result.system = derivation.system();
  return result;
}

std::string mark_of(const std::string& effect) { return "effect " + effect; }

TransitionSystem under(const EffectSystem& effects, const model::DdsProfile& dds,
                       const std::vector<bool>& fixed) {
  Exprs from;
  Exprs to;
  for (std::size_t k = 0; k < effects.knobs.size(); ++k) {
    if (!fixed[k]) continue;
    from.push_back(effects.unknowns[k]);
    to.push_back(effects.knobs[k].value(dds));
  }
  return with(effects.system, from, to);
}

}  // namespace stormproof::tables
