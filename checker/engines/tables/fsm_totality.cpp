// fsm.totality: every (state, event) is handled on every input, or is listed in
// specs/ignored-pairs.yaml as one that may do nothing; and nothing is listed there that is handled.
#include "checker/engines/tables/ignored_pairs.hpp"
#include "checker/engines/tables/machine_view.hpp"
#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {
namespace {

struct Tally {
  std::size_t handled = 0;
  std::size_t no_row = 0;
  std::size_t guards_reject = 0;
};

void check_pair(Proof& proof, const MachineView& machine, const IgnoredPairs& listed,
                fsm::StateId state, std::uint8_t event, Tally& tally) {
  const IgnoredPairs::Pair pair{machine.info.states[state], machine.info.events[event]};
  const std::string text = machine.pair_text(state, event);
  const bool in_no_row = listed.no_row.contains(pair);
  const bool in_reject = listed.guards_reject.contains(pair);
  const std::vector<RowView> rows = machine.rows_of(state, event);
  if (rows.empty()) {
    ++tally.no_row;
    if (!in_no_row) proof.violate(text + " has no row and is not listed as ignored");
    if (in_reject) proof.violate(text + " is listed with guards, but has no row");
    return;
  }
  if (in_no_row) proof.violate(text + " is listed as having no row, but has one");
  Exprs none_enabled;
  for (const RowView& row : rows) none_enabled.push_back(!row.enabled);
  const auto decision = proof.ask(text + ": no row enabled", none_enabled);
  if (decision.answer == smt::Answer::sat) {
    ++tally.guards_reject;
    if (in_reject) return;
    proof.violate(text + ": no row is enabled with " + values_in(*decision.model, machine.inputs) +
                  ", and the pair is not listed as ignored");
  } else if (decision.answer == smt::Answer::unsat) {
    ++tally.handled;
    if (in_reject) proof.violate(text + " is listed as ignored on some input, but never is");
  }
}

}  // namespace

Finding fsm_totality(const CheckRequest& request) {
  Proof proof{"fsm.totality", request};
  proof.assume("The inputs of a machine range freely; no relation between them is assumed.");
  for (const MachineView& machine : machine_views(proof)) {
    const IgnoredPairs listed = ignored_pairs(machine.info.name);
    Tally tally;
    for (fsm::StateId state = 0; state < machine.info.states.size(); ++state) {
      for (std::uint8_t event = 0; event < machine.info.events.size(); ++event) {
        check_pair(proof, machine, listed, state, event, tally);
      }
    }
    proof.detail(std::string{machine.info.name} + ": " + std::to_string(tally.handled) +
                 " pairs handled on every input, " + std::to_string(tally.guards_reject) +
                 " on some, " + std::to_string(tally.no_row) + " without a row; " +
                 std::to_string(listed.no_row.size() + listed.guards_reject.size()) + " listed");
  }
  return proof.finish(
      "for every machine, each state and event compared with the list of pairs "
      "that are legally ignored");
}

}  // namespace stormproof::tables
