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

}  // namespace stormproof::tables
