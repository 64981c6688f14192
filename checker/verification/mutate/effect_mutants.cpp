// Names and describes the mistakes that a recorded composition allows.
#include "checker/verification/mutate/effect_mutants.hpp"

#include <fmt/core.h>

#include "fsm/composition/composition_info.hpp"
#include "fsm/composition/compositions.hpp"

namespace stormproof::mutate {

namespace {

namespace comp = fsm::composition;
using EffectChange = comp::EffectMutation::Change;

std::string in_words(EffectChange change) {
  switch (change) {
    case EffectChange::drop:
      return "does not happen";
    case EffectChange::twice:
      return "happens twice";
    case EffectChange::after_next:
      return "happens after the effect that follows it";
    case EffectChange::at_once:
      return "is due at once";
    case EffectChange::other_delay:
      return "is due after another delay";
    case EffectChange::every_reader:
      return "happens for every reader of the writer";
    case EffectChange::first_only:
      return "is done for the first only";
    case EffectChange::reversed:
      return "happens in the reverse direction";
    case EffectChange::negated:
      return "is negated";
    case EffectChange::always:
      return "is not looked at";
    case EffectChange::none:
      break;
  }
  return "stays as it is";
}

CatalogueEntry entry_of(const comp::EffectMutation& mutation, std::string_view what) {
  CatalogueEntry entry;
  entry.mutant.id = fmt::format("{}:{}:{}", mutation.composition, mutation.effect,
                                comp::word_of(mutation.change));
  entry.mutant.description =
      fmt::format("{}: “{}” {}", mutation.effect, what, in_words(mutation.change));
  entry.mutant.rules.effects.push_back(mutation);
  entry.concerns = mutation.composition == "paper" ? Concerns::paper : Concerns::fastdds;
  entry.kind = Kind::effect;
  return entry;
}

}  // namespace

std::vector<CatalogueEntry> effect_mutants() {
  std::vector<CatalogueEntry> list;
  for (const comp::CompositionInfo& composition : comp::compositions()) {
    for (const comp::EffectMutation& mutation : comp::effect_mutations(composition)) {
      list.push_back(entry_of(mutation, mutation.what));
    }
  }
  return list;
}

}  // namespace stormproof::mutate
