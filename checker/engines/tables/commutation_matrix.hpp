// Does the order of two same-time events on one relation matter? For each pair of event kinds: two
// events with free inputs happen in both orders from one free state; the order matters if the final
// states differ, or what was emitted and scheduled in all. What an event does is the rule of the
// composition (checker/engines/tables/event_kinds.hpp); the comparison is here.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "checker/engines/tables/proof.hpp"
#include "checker/engines/tables/symbolic_run.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {

/// What is said of an event before it happens.
struct EventConditions {
  Expr possible;    ///< such an event can be pending in the state
  Expr consistent;  ///< what is only known of events of real runs
};

struct EventKind {
  std::string name;
  /// Lets an event happen; the names of its inputs begin with the given text.
  std::function<void(SymbolicRun&, const std::string& event)> happen;
  std::function<EventConditions(SymbolicRun& before, const std::string& event)> conditions;
};

/// Kinds of events that are compared with each other.
struct EventGroup {
  std::string of_what;
  std::function<Expr(SymbolicRun& before)> possible;    ///< what every deployment keeps
  std::function<Expr(SymbolicRun& before)> consistent;  ///< what is known of the states of runs
  std::vector<EventKind> kinds;
};

/// The events of the compositions: those of one relation, its writer and its queue, and those of
/// announcements, which meet a relation only in its openings; these are events of the former.
[[nodiscard]] std::vector<EventGroup> events_of(model::Of<fsm::composition::paper::Paper>);
[[nodiscard]] std::vector<EventGroup> events_of(model::Of<fsm::composition::fastdds::FastDds>);

enum class Verdict : char {
  commutes = '.',     ///< from every state
  matters = 'X',      ///< in a state that is consistent
  unreachable = 'u',  ///< only in states that no run reaches
  unknown = '?'       ///< no answer; of a mutant also: as without it
};

struct PairResult {
  std::size_t first = 0;
  std::size_t second = 0;
  Verdict verdict = Verdict::unknown;
  std::string witness;  ///< of `matters` and `unreachable`
};

/// All unordered pairs of kinds, in a deployment of this size; none behind the one of which
/// `goes_on` says no. With a mutant only those are asked of which an event steps a machine with a
/// mistake: without such a step both orders lead to what they lead to without the mutant.
[[nodiscard]] std::vector<PairResult> commutation_matrix(
    Proof& proof, const EventGroup& group, Extent extent,
    const std::function<bool(const PairResult&)>& goes_on = {});

/// The matrix as lines of text.
[[nodiscard]] std::vector<std::string> matrix_lines(const EventGroup& group,
                                                    const std::vector<PairResult>& results);

}  // namespace stormproof::tables
