// Every machine as data with its guards as solver expressions: what the proofs about tables as such
// (`fsm.*`) iterate over. Compiling all tables over expressions happens in one source file.
#pragma once

#include <string>
#include <vector>

#include "checker/engines/tables/proof.hpp"
#include "fsm/machine_info.hpp"
#include "fsm/table_mutation.hpp"

namespace stormproof::tables {

struct RowView {
  fsm::StateId source = 0;
  std::uint8_t event = 0;
  fsm::StateId target = 0;
  Expr enabled;  ///< over the inputs
};

struct MachineView {
  fsm::MachineInfo info;  ///< as written: its `rows` are not those of a mutant
  std::vector<RowView> rows;
  Exprs inputs;  ///< the unknowns that guards may read

  [[nodiscard]] std::string pair_text(fsm::StateId state, std::uint8_t event) const {
    return std::string{info.name} + ": " + std::string{info.states[state]} + " on " +
           std::string{info.events[event]};
  }
  [[nodiscard]] std::string row_text(const RowView& row) const {
    return pair_text(row.source, row.event) + " to " + std::string{info.states[row.target]};
  }
  /// The rows of one pair of state and event.
  [[nodiscard]] std::vector<RowView> rows_of(fsm::StateId state, std::uint8_t event) const {
    std::vector<RowView> found;
    for (const RowView& row : rows) {
      if (row.source == state && row.event == event) found.push_back(row);
    }
    return found;
  }
};

class Proof;

/// The machines whose tables have to be looked at, with the mistakes of the mutant: all, or those
/// with a mistake.
[[nodiscard]] std::vector<MachineView> machine_views(const Proof& proof);

}  // namespace stormproof::tables
