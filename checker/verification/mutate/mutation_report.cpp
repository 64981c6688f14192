// What a list of tried mutants says altogether.
#include <algorithm>

#include "checker/verification/mutate/mutate.hpp"

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

std::size_t MutationReport::seen_at_effects() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, [](const MutantResult& mutant) {
    return mutant.kind == Kind::effect && !mutant.unseen();
  }));
}

std::size_t MutationReport::noticed_in_rules() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, [](const MutantResult& mutant) {
    return mutant.kind == Kind::effect && mutant.noticed_in_rules();
  }));
}

std::size_t MutationReport::only_followed() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, [](const MutantResult& mutant) {
    return mutant.noticed() && !mutant.noticed_in_rules();
  }));
}

bool MutationReport::notices_enough() const {
  constexpr std::size_t required_percent = 95;
  constexpr std::size_t required_in_rules = 60;
  return 100 * killed() >= required_percent * (mutants.size() - unseen()) &&
         100 * noticed_in_rules() >= required_in_rules * seen_at_effects();
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
