// What a list of tried mutants says altogether.
#include <algorithm>

#include "checker/verification/mutate/mutate.hpp"

namespace stormproof::mutate {

bool MutantResult::noticed() const {
  const bool by_law = kind == Kind::effect && killed_by_laws && !killed_by_laws->empty();
  return !killed_by.empty() || by_law;
}

std::size_t MutationReport::killed() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, &MutantResult::noticed));
}

std::size_t MutationReport::unseen() const {
  return static_cast<std::size_t>(
      std::ranges::count(mutants, false, &MutantResult::makes_a_difference));
}

std::size_t MutationReport::only_followed() const {
  const auto is_only = [](const MutantResult& mutant) {
    const bool by_law = mutant.killed_by_laws && !mutant.killed_by_laws->empty();
    return !by_law && mutant.killed_by == std::vector<std::string>{"composition.followed"};
  };
  return static_cast<std::size_t>(std::ranges::count_if(mutants, is_only));
}

bool MutationReport::notices_enough() const {
  constexpr std::size_t required_percent = 95;
  return 100 * killed() >= required_percent * (mutants.size() - unseen());
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
