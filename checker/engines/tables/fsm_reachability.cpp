// fsm.reachability: every state of a machine can be reached from its initial one, and every row can
// fire. A row that cannot is dead: a rule that somebody wrote down and nobody executes.
#include <map>
#include <set>

#include "checker/engines/tables/ignored_pairs.hpp"
#include "checker/engines/tables/machine_view.hpp"
#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {
namespace {

/// Which rows have a guard that some input satisfies. Equal guards are asked about once.
std::vector<bool> satisfiable_rows(Proof& proof, const MachineView& machine) {
  std::map<unsigned, bool> known;  // by the guard's number in the context
  std::vector<bool> result;
  for (const RowView& row : machine.rows) {
    const unsigned guard = Z3_get_ast_id(proof.context(), row.enabled);
    if (!known.contains(guard)) {
      known[guard] = row.enabled.is_true() ||
                     proof.possible(machine.row_text(row) + ": guard satisfiable", {row.enabled});
    }
    result.push_back(known[guard]);
  }
  return result;
}

void check_machine(Proof& proof, const MachineView& machine) {
  const std::vector<bool> satisfiable = satisfiable_rows(proof, machine);
  std::set<fsm::StateId> reached{machine.info.initial};
  for (std::size_t round = 0; round < machine.info.states.size(); ++round) {
    for (std::size_t k = 0; k < machine.rows.size(); ++k) {
      const RowView& row = machine.rows[k];
      if (satisfiable[k] && reached.contains(row.source)) reached.insert(row.target);
    }
  }
  const std::string name{machine.info.name};
  for (fsm::StateId state = 0; state < machine.info.states.size(); ++state) {
    if (reached.contains(state)) continue;
    proof.violate(name + ": state " + std::string{machine.info.states[state]} +
                  " cannot be reached from " +
                  std::string{machine.info.states[machine.info.initial]});
  }
  std::size_t live = 0;
  for (std::size_t k = 0; k < machine.rows.size(); ++k) {
    const bool fires = satisfiable[k] && reached.contains(machine.rows[k].source);
    live += fires ? 1 : 0;
    if (!fires) proof.violate(machine.row_text(machine.rows[k]) + " is dead: it can never fire");
  }
  proof.detail(name + ": " + std::to_string(reached.size()) + " of " +
               std::to_string(machine.info.states.size()) + " states reached, " +
               std::to_string(live) + " of " + std::to_string(machine.rows.size()) +
               " rows can fire; " + std::to_string(ignored_pairs(name).never_occur.size()) +
               " pairs without a row are listed as never occurring in a run");
}

}  // namespace

Finding fsm_reachability(const CheckRequest& request) {
  Proof proof{"fsm.reachability", request};
  proof.assume(
      "The inputs of a machine range freely, so this is about the table: what its surroundings "
      "never ask of it in a run counts as possible here.");
  for (const MachineView& machine : machine_views(proof)) {
    check_machine(proof, machine);
  }
  proof.detail(
      "remark: HeartbeatTimer, Idle on SuppressionEnded: its guard can hold, but in a run of the "
      "periodic policy a suppressed descriptor is unacknowledged, and then the timer is armed.");
  return proof.finish("states closed over rows with a satisfiable guard, for every machine");
}

}  // namespace stormproof::tables
