// A few descriptors of a few readers of a few writers, as solver expressions: events happen to them
// one after the other, from a state of which nothing is known. Nothing is declared: a variable
// comes into being when a rule first reads it, as an unknown of its name. What is emitted and
// scheduled is kept as a list. checker/engines/tables/symbolic_world.hpp is the world that executes
// rules on it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "checker/engines/tables/proof.hpp"
#include "fsm/table_mutation.hpp"

namespace stormproof::tables {

/// How many of each there are.
struct Extent {
  int descriptors = 2;
  int readers = 2;
  int streams = 2;
};

/// Where something is: ours, unless it says otherwise. A relation is one of the stream's writer of
/// the participant and of its reader at the peer, another participant.
struct Place {
  int participant = 0;
  int stream = 0;
  int peer = 1;
  int descriptor = 0;

  /// The same with these indices only, those of an owner (fsm::composition::Owner::indices).
  [[nodiscard]] Place of(std::uint8_t indices) const;
  /// "" of ours, otherwise " (reader 2, descriptor 1)": the indices that differ.
  [[nodiscard]] std::string text() const;
};

/// Something that is emitted or scheduled, if `when` holds.
struct SymbolicEffect {
  std::string what;  ///< "HeartbeatExpiry", "AckNack (reader 2)"
  Expr when;
  Exprs content;  ///< what the packet says, or the time; as many for each effect of this name
};

class SymbolicRun {
 public:
  SymbolicRun(Extent extent, const std::vector<fsm::TableMutation>& mistakes)
      : extent_{extent}, mistakes_{mistakes} {}

  [[nodiscard]] const Extent& extent() const { return extent_; }
  [[nodiscard]] const std::vector<fsm::TableMutation>& mistakes() const { return mistakes_; }

  /// The present value of a variable.
  Expr& truth(const std::string& name);
  Expr& number(const std::string& name);
  /// The states of a machine: the names of one variable for each.
  void machine(const std::vector<std::string>& states);
  /// Unknowns that no event changes, and those of one event.
  Expr knob(const Expr& unknown);
  Expr input(const Expr& unknown);

  /// A machine takes a step here; its name.
  void steps(std::string_view machine) { stepped_.emplace(machine); }
  [[nodiscard]] const std::set<std::string, std::less<>>& stepped() const { return stepped_; }

  void happens(SymbolicEffect effect) { effects_.push_back(std::move(effect)); }

  struct Variable {
    Expr at_first;
    Expr now;
  };
  [[nodiscard]] const std::map<std::string, Variable>& variables() const { return variables_; }
  [[nodiscard]] const std::vector<SymbolicEffect>& effects() const { return effects_; }
  [[nodiscard]] Exprs knobs() const;
  [[nodiscard]] Exprs inputs() const;
  /// The first state is one: each machine is in one state, and no count is negative.
  [[nodiscard]] Expr possible() const;

 private:
  Extent extent_;
  const std::vector<fsm::TableMutation>& mistakes_;
  std::map<std::string, Variable> variables_;
  std::map<std::string, Exprs> machines_;  ///< by the name of the first state
  std::set<std::string, std::less<>> stepped_;
  std::map<std::string, Expr> knobs_;
  std::map<std::string, Expr> inputs_;
  std::vector<SymbolicEffect> effects_;
};

}  // namespace stormproof::tables
