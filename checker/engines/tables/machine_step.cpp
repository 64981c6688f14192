// States as lists of truth values.
#include "checker/engines/tables/machine_step.hpp"

namespace stormproof::tables {

Expr exactly_one(const OneHot& state) {
  Exprs conditions{any_of(state)};
  for (std::size_t i = 0; i < state.size(); ++i) {
    for (std::size_t j = i + 1; j < state.size(); ++j) {
      conditions.push_back(!(state[i] && state[j]));
    }
  }
  return all_of(conditions);
}

std::size_t state_in(const z3::model& model, const OneHot& state) {
  std::size_t k = 0;
  while (k + 1 < state.size() && !is_true_in(model, state[k])) ++k;
  return k;
}

}  // namespace stormproof::tables
