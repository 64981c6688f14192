// A transition system unrolled over time: copies of its variables and inputs, and which step is
// taken. The solver looks for steps from an initial to a bad state in it.
#pragma once

#include "checker/engines/tables/transition_system.hpp"

namespace stormproof::tables {

/// One step that a model takes.
struct TakenStep {
  std::size_t step = 0;  ///< its number in the system
  Exprs inputs;          ///< their values
};

class Unrolling {
 public:
  /// Of no step. `system` must outlive it.
  explicit Unrolling(const TransitionSystem& system);

  /// Adds one more step.
  void extend();
  /// What must hold if the last state is to be bad.
  [[nodiscard]] Exprs ends_badly() const;

  /// The steps that a model takes, in words, with what changes at each.
  [[nodiscard]] std::vector<std::string> lines(const z3::model& model) const;
  /// The same as data.
  [[nodiscard]] std::vector<TakenStep> steps(const z3::model& model) const;
  /// The values of the variables in the first state.
  [[nodiscard]] Exprs start(const z3::model& model) const;

 private:
  [[nodiscard]] std::string changes(const z3::model& model, std::size_t t) const;
  [[nodiscard]] Exprs copies(const Exprs& originals, const std::string& suffix) const;

  const TransitionSystem& system_;
  z3::context& context_;
  std::vector<Exprs> states_;
  std::vector<Exprs> taken_;                // by time and step
  std::vector<std::vector<Exprs>> inputs_;  // by time and step
  Exprs conditions_;
};

}  // namespace stormproof::tables
