// The work on one property: its solver context, the questions asked about it, and the verdict they
// add up to. A question without an answer makes the verdict inconclusive here, and one to which the
// solvers give opposite answers makes it disputed, so that no property can forget it.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/smt/decision.hpp"
#include "checker/engines/smt/symbolic.hpp"

namespace stormproof::tables {

using Expr = z3::expr;
using Exprs = std::vector<z3::expr>;

/// An assumption of every verdict that rests on a composition.
inline constexpr const char* hosts_keep_contracts =
    "What the rules leave to a host (draw composition: packing, queues, the piggyback budget) "
    "keeps "
    "its contracts.";

class Proof {
 public:
  Proof(std::string_view property, const checker::CheckRequest& request);

  [[nodiscard]] z3::context& context() { return context_; }
  [[nodiscard]] const std::string& property() const { return property_; }
  [[nodiscard]] const checker::CheckRequest& request() const { return request_; }
  /// The mistakes of the mutant; none without one.
  [[nodiscard]] const model::Mutation& mistakes() const;
  /// Whether the table of this machine has to be looked at. Of a mutant it is only asked whether it
  /// is noticed, and tables without a mistake are those that are decided without it.
  [[nodiscard]] bool concerns(std::string_view machine) const;
  /// The scenario that runs: the mutant may have changed its knobs.
  [[nodiscard]] const model::Scenario& scenario() const { return scenario_; }

  /// Asks whether all `conditions` can hold together. `query` says so in words.
  smt::Decision ask(std::string_view query, const Exprs& conditions);
  /// The same if the answer alone matters. An unknown is remembered.
  [[nodiscard]] bool possible(std::string_view query, const Exprs& conditions) {
    return ask(query, conditions).answer == smt::Answer::sat;
  }
  /// Something went wrong that makes a proof worthless.
  void give_up(std::string why);
  /// Two answers contradict each other: no verdict counts.
  void dispute(std::string why);

  /// What has been said until now; no verdict yet.
  [[nodiscard]] const props::Finding& so_far() const { return finding_; }
  void assume(std::string sentence) { finding_.assumptions.push_back(std::move(sentence)); }
  void detail(std::string line) { finding_.details.push_back(std::move(line)); }
  /// The property does not hold; `line` says why.
  void violate(std::string line);
  [[nodiscard]] bool violated() const { return violated_; }

  /// The verdict: disputed, inconclusive, violated, or else proved; `how` names the method. To be
  /// called once, at the end.
  [[nodiscard]] props::Finding finish(std::string how);

 private:
  const checker::CheckRequest& request_;
  std::string property_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  model::Scenario scenario_;
  z3::context context_;
  smt::SymbolicContext current_{context_};
  props::Finding finding_;
  std::string gap_;      ///< why nothing is proved; empty: every question was answered
  std::string dispute_;  ///< what contradicts what; empty: nothing
  std::size_t asked_ = 0;
  bool violated_ = false;
};

/// Disjunction and conjunction of any number of expressions, also of none.
[[nodiscard]] Expr any_of(const Exprs& parts);
[[nodiscard]] Expr all_of(const Exprs& parts);

/// "listed = true, pending = 2": the values of the unknowns in a model.
[[nodiscard]] std::string values_in(const z3::model& model, const Exprs& unknowns);
/// "listed, pending = 2": those of them that are not false and not 0; empty if there are none.
[[nodiscard]] std::string notable_in(const z3::model& model, const Exprs& unknowns);
/// A number or truth value of a model in plain spelling.
[[nodiscard]] std::string value_text(const z3::model& model, const Expr& expr);
[[nodiscard]] bool is_true_in(const z3::model& model, const Expr& expr);

}  // namespace stormproof::tables
