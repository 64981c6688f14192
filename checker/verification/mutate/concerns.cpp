// Asks the recorded compositions, and what is true of their implementations.
#include "checker/verification/mutate/concerns.hpp"

#include <algorithm>

#include "fsm/composition/amended.hpp"
#include "model/composition_of.hpp"
#include "model/engine/timer_kinds.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::mutate {

namespace {

namespace comp = fsm::composition;

/// Of those that profiles name, whether or not engines know their writers: `composition.followed`
/// says something of each.
Concerns where(auto&& holds) {
  Concerns list;
  std::ranges::copy_if(model::implementations, std::back_inserter(list), holds);
  return list;
}

bool has_machine(const comp::CompositionInfo& composition, std::string_view machine) {
  return std::ranges::any_of(composition.parts,
                             [&](const comp::PartInfo& part) { return part.machine == machine; });
}

/// What an effect feeds begins with the name of the event.
bool feeds(const comp::EffectInfo& effect, std::string_view part, std::string_view event) {
  return effect.kind.starts_with("feed") && effect.target == part &&
         effect.detail.substr(0, effect.detail.find(' ')) == event;
}

bool feeds(const comp::CompositionInfo& composition, std::string_view machine,
           std::string_view event) {
  for (const comp::PartInfo& part : composition.parts) {
    if (part.machine != machine) continue;
    for (const auto* rules : {&composition.rules, &composition.procedures}) {
      for (const comp::RuleInfo& rule : *rules) {
        const auto is_it = [&](const comp::EffectInfo& one) {
          return feeds(one, part.name, event);
        };
        if (std::ranges::any_of(rule.effects, is_it)) return true;
      }
    }
  }
  return false;
}

template <class Composition>
bool has_timer(model::EventKind kind) {
  bool found = false;
  comp::for_each_type(typename Composition::Timers{},
                      [&]<class Timer>() { found = found || model::event_kind_of<Timer> == kind; });
  return found;
}

}  // namespace

/// All whose writers the engines know.
Concerns everywhere() { return model::known_to_engines(); }

Concerns where_is_fed(std::string_view machine, std::string_view event) {
  const Concerns owners = where([&](model::ImplementationKind kind) {
    return has_machine(model::composition_of(kind), machine);
  });
  if (owners.empty()) return everywhere();
  return where([&](model::ImplementationKind kind) {
    return feeds(model::composition_of(kind), machine, event);
  });
}

Concerns where_happens(model::EventKind kind) {
  const Concerns scheduling = where([&](model::ImplementationKind implementation) {
    return model::visit_composition(implementation, [&]<class Composition>(model::Of<Composition>) {
      return has_timer<Composition>(kind);
    });
  });
  if (!scheduling.empty()) return scheduling;
  if (kind != model::EventKind::delayed_reception) return everywhere();
  return where([](model::ImplementationKind implementation) {
    return !model::traits_of(implementation).receives_separately;
  });
}

Concerns where_rules_are_knobs() {
  return where([](model::ImplementationKind implementation) {
    return !model::traits_of(implementation).fixed_rules;
  });
}

Concerns where_is_composition(std::string_view name) {
  for (std::size_t k = 0; k < model::implementation_traits.size(); ++k) {
    const auto kind = static_cast<model::ImplementationKind>(k);
    if (applicability_of(*props::find_property("composition.followed"), kind).applies() &&
        model::composition_of(kind).name == name)
      return {kind};
  }
  return {};
}

}  // namespace stormproof::mutate
