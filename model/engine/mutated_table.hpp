// The interpreter that steps a machine in place of Boost.MSM when a run has a deliberate mistake in
// that machine's table (model/mutation.hpp). A correct run has none, so the test for it is all that
// it pays.
#pragma once

#include <algorithm>
#include <memory>

#include "fsm/row_table.hpp"
#include "model/mutation.hpp"

namespace stormproof::model {

/// The mutated table of `Machine`, or null if its table is as it should be.
template <class Machine>
std::unique_ptr<const fsm::TableInterpreter<Machine>> mutated_table(const Mutation* mutation) {
  if (mutation == nullptr) return nullptr;
  const bool concerned = std::ranges::any_of(
      mutation->tables, [](const auto& m) { return m.machine == fsm::name_of<Machine>(); });
  if (!concerned) return nullptr;
  return std::make_unique<const fsm::TableInterpreter<Machine>>(mutation->tables);
}

}  // namespace stormproof::model
