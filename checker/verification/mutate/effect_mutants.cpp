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

/// Why nothing can be said of a mistake that does change runs.
std::string survives_because(const comp::EffectMutation& mutation) {
  if (mutation.what.starts_with("perform RefillBudget") ||
      mutation.what.starts_with("perform Charge")) {
    return "the piggyback budget is left to the host: its contract does not say when it is used up";
  }
  if (mutation.what.starts_with("cancel")) {
    return "what replaces an event of a cycle has cancelled all of them together; batches may be "
           "due "
           "at any time by the contract of PlanBatches";
  }
  const bool takes = mutation.what == "perform TakeRelayed" || mutation.what == "call TakePacket";
  if (takes && mutation.change == EffectChange::twice) {
    return "a packet that is taken twice says nothing the second time";
  }
  return "";
}

CatalogueEntry entry_of(const comp::EffectMutation& mutation) {
  CatalogueEntry entry;
  entry.mutant.id = fmt::format("{}:{}:{}", mutation.composition, mutation.effect,
                                comp::word_of(mutation.change));
  entry.mutant.description =
      fmt::format("{}: “{}” {}", mutation.effect, mutation.what, in_words(mutation.change));
  entry.mutant.rules.effects.push_back(mutation);
  entry.concerns = where_is_composition(mutation.composition);
  entry.kind = Kind::effect;
  entry.survives_because = survives_because(mutation);
  return entry;
}

}  // namespace

std::vector<CatalogueEntry> effect_mutants() {
  std::vector<CatalogueEntry> list;
  for (const comp::CompositionInfo& composition : comp::compositions()) {
    for (const comp::EffectMutation& mutation : comp::effect_mutations(composition)) {
      CatalogueEntry entry = entry_of(mutation);
      if (!entry.concerns.empty()) list.push_back(std::move(entry));
    }
  }
  return list;
}

}  // namespace stormproof::mutate
