// Does the order of two same-time events on one relation matter? For each pair of event kinds: two
// events with free inputs are processed in both orders from one free state; the order matters if
// the final states or what was emitted and scheduled in all differ. A relation says what its state
// is, which kinds of events there are and what each does (built from the tables); the comparison
// is here.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "checker/engines/tables/proof.hpp"

namespace stormproof::tables {

/// What an event does.
struct Outcome {
  Exprs state;    ///< the new value of each state variable
  Exprs outputs;  ///< how many of each kind of output (integers)
};

/// One event of some kind with its own unknown inputs.
struct EventInstance {
  Exprs inputs;
  Expr possible;    ///< over state and inputs: such an event can be pending in the state
  Expr consistent;  ///< the same for what is only known of states and events of real runs
  std::function<Outcome(const Exprs& state)> apply;
};

struct EventKindModel {
  std::string name;
  bool repeats = true;  ///< two of them can be pending at once
  /// Makes an event whose inputs have this prefix; `state` is where it is pending.
  std::function<EventInstance(const std::string& prefix, const Exprs& state)> make;
};

struct RelationModel {
  Exprs variables;  ///< the state
  Exprs knobs;      ///< unknowns that no event changes
  Expr possible;    ///< the states that there are
  Expr consistent;  ///< what is known of the states of real runs
  std::vector<std::string> outputs;
  std::vector<EventKindModel> kinds;
};

/// The paper's relation (fsm/descriptor_repair.hpp and its neighbours), and Fast DDS's.
[[nodiscard]] RelationModel paper_relation(Proof& proof);
[[nodiscard]] RelationModel fastdds_relation(Proof& proof);

enum class Verdict : char {
  commutes = '.',     ///< from every state
  matters = 'X',      ///< in a state that is consistent
  unreachable = 'u',  ///< only in states that no run reaches
  excluded = '-',     ///< two of this kind are never pending at once
  unknown = '?'
};

struct PairResult {
  std::size_t first = 0;
  std::size_t second = 0;
  Verdict verdict = Verdict::unknown;
  std::string witness;  ///< of `matters` and `unreachable`
};

/// All unordered pairs of kinds.
[[nodiscard]] std::vector<PairResult> commutation_matrix(Proof& proof,
                                                         const RelationModel& relation);

/// The matrix as lines of text.
[[nodiscard]] std::vector<std::string> matrix_lines(const RelationModel& relation,
                                                    const std::vector<PairResult>& results);

}  // namespace stormproof::tables
