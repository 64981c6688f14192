// fsm.determinism: in no state do two rows of a machine fire on one event. Boost.MSM would silently
// take the later one, so a table with an overlap means something else than it says.
#include "checker/engines/tables/machine_view.hpp"
#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {
namespace {

struct Overlap {
  RowView first;
  RowView second;
  Expr both;
};

std::vector<Overlap> candidates(const MachineView& machine) {
  std::vector<Overlap> pairs;
  for (std::size_t i = 0; i < machine.rows.size(); ++i) {
    for (std::size_t j = i + 1; j < machine.rows.size(); ++j) {
      const RowView& a = machine.rows[i];
      const RowView& b = machine.rows[j];
      if (a.source != b.source || a.event != b.event) continue;
      pairs.push_back({a, b, a.enabled && b.enabled});
    }
  }
  return pairs;
}

}  // namespace

Finding fsm_determinism(const CheckRequest& request) {
  Proof proof{"fsm.determinism", request};
  proof.assume("The inputs of a machine range freely; no relation between them is assumed.");
  for (const MachineView& machine : machine_views(proof)) {
    const std::vector<Overlap> pairs = candidates(machine);
    if (pairs.empty()) {
      proof.detail(std::string{machine.info.name} + ": at most one row per state and event");
      continue;
    }
    Exprs overlaps;
    for (const Overlap& pair : pairs) overlaps.push_back(pair.both);
    const auto decision =
        proof.ask(std::string{machine.info.name} + ": two rows enabled", {any_of(overlaps)});
    if (decision.answer == smt::Answer::unsat) {
      proof.detail(std::string{machine.info.name} + ": " + std::to_string(pairs.size()) +
                   " pairs of rows, none enabled together");
    }
    if (decision.answer != smt::Answer::sat) continue;
    for (const Overlap& pair : pairs) {
      if (!is_true_in(*decision.model, pair.both)) continue;
      proof.violate(machine.row_text(pair.first) + " and to " +
                    std::string{machine.info.states[pair.second.target]} + " both fire with " +
                    values_in(*decision.model, machine.inputs));
    }
  }
  return proof.finish("no input enables two rows, for every machine, state and event");
}

}  // namespace stormproof::tables
