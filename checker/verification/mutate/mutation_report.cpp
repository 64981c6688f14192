// What a list of tried mutants says altogether.
#include <algorithm>

#include "checker/verification/mutate/mutate.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"

namespace stormproof::mutate {

bool MutantResult::noticed() const {
  const bool by_law = kind == Kind::effect && killed_by_laws && !killed_by_laws->empty();
  return !killed_by.empty() || by_law;
}

bool MutantResult::noticed_in_rules() const {
  return noticed() &&
         (kind != Kind::effect || killed_by != std::vector<std::string>{std::string{followed}});
}

std::size_t MutationReport::killed() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, &MutantResult::noticed));
}

std::size_t MutationReport::unseen() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, &MutantResult::unseen));
}

bool Share::suffices() const {
  constexpr std::size_t required_percent = 60;
  return !is_expected || 100 * noticed >= required_percent * seen;
}

std::vector<Share> MutationReport::shares() const {
  std::vector<Share> list;
  for (const MutantResult& mutant : mutants) {
    if (mutant.kind != Kind::effect || mutant.unseen()) continue;
    const std::string composition = mutant.id.substr(0, mutant.id.find(':'));
    auto share = std::ranges::find(list, composition, &Share::composition);
    if (share == list.end()) {
      const auto has_it = [&](model::ImplementationKind kind) {
        return model::composition_of(kind).name == composition;
      };
      const bool is_known = std::ranges::any_of(model::known_to_engines(), has_it);
      share = list.insert(list.end(), {composition, 0, 0, is_known});
    }
    ++share->seen;
    share->noticed += mutant.noticed_in_rules() ? 1U : 0U;
  }
  return list;
}

std::size_t MutationReport::seen_at_effects() const {
  std::size_t seen = 0;
  for (const Share& share : shares()) seen += share.seen;
  return seen;
}

std::size_t MutationReport::noticed_in_rules() const {
  std::size_t noticed = 0;
  for (const Share& share : shares()) noticed += share.noticed;
  return noticed;
}

std::size_t MutationReport::only_followed() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, [](const MutantResult& mutant) {
    return mutant.noticed() && !mutant.noticed_in_rules();
  }));
}

bool MutationReport::notices_enough() const {
  constexpr std::size_t required_percent = 95;
  return 100 * killed() >= required_percent * (mutants.size() - unseen()) &&
         std::ranges::all_of(shares(), &Share::suffices);
}

std::size_t MutationReport::killed_by(std::string_view property) const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(), [&](const MutantResult& mutant) {
        const auto& list = mutant.killed_by;
        return std::find(list.begin(), list.end(), property) != list.end();
      }));
}

std::size_t MutationReport::killed_by_laws() const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(), [](const MutantResult& mutant) {
        return mutant.killed_by_laws && !mutant.killed_by_laws->empty();
      }));
}

std::size_t MutationReport::tried_on_laws() const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(),
                    [](const MutantResult& mutant) { return mutant.killed_by_laws.has_value(); }));
}

std::size_t MutationReport::killed_by_law(std::string_view law) const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(), [&](const MutantResult& mutant) {
        const auto& list = mutant.killed_by_laws;
        return list && std::find(list->begin(), list->end(), law) != list->end();
      }));
}

}  // namespace stormproof::mutate
