// Writes the transition table of a machine as Promela macros, one for each event:
//   inline DescriptorRepair_AckNackReceived(state, d, Listed, Confirmed)
// The rows come from the recorded machine. What a guard tests is an argument, by the guard's name:
// the rule that feeds the event says what holds there, with the guard's own terms over expressions,
// so that the model states no rule a second time. What a row asks for are bits of an outbox, bit d
// for descriptor d.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/promela/expression.hpp"
#include "fsm/program/program.hpp"

namespace stormproof::promela {

class TableMacros {
 public:
  using Program = fsm::program::Program;
  using Ref = fsm::program::Ref;

  /// The table of a part, with the mistakes that concern its machine.
  TableMacros(const Program& program, fsm::program::Tag part,
              const std::vector<fsm::TableMutation>& mistakes)
      : terms_{&program.terms},
        machine_{&program.machine_of(part)},
        rows_{fsm::program::rows_of(*machine_, mistakes)} {}

  [[nodiscard]] std::string state(fsm::StateId number) const;
  [[nodiscard]] std::string initial() const { return state(machine_->initial); }
  [[nodiscard]] std::string outbox(std::size_t field) const;
  [[nodiscard]] std::string name(std::uint8_t event) const;
  /// What the guards of the event's rows test, in the order of the macro's arguments.
  [[nodiscard]] std::vector<Ref> tests(std::uint8_t event) const;
  /// Whether some row of the event asks for this field of the outbox, which is a truth value.
  [[nodiscard]] bool asks(std::uint8_t event, std::size_t field) const;
  [[nodiscard]] std::size_t fields() const { return machine_->outputs.size(); }

  /// `#define DescriptorRepair_U 0` … for the states.
  [[nodiscard]] std::string states() const;
  [[nodiscard]] std::string macro(std::uint8_t event) const;

 private:
  using Row = fsm::program::Machine::Row;
  /// What is said of a guard, by its name.
  using Leaf = std::function<Truth(std::string_view)>;

  /// The guards with a name that the event's rows consist of, each name once.
  [[nodiscard]] std::vector<Ref> leaves(std::uint8_t event) const;
  void add_leaves(std::vector<Ref>& leaves, Ref guard) const;
  [[nodiscard]] Truth formula(Ref guard, const Leaf& leaf) const;
  [[nodiscard]] Truth guard(const Row& row, const Leaf& leaf) const;
  [[nodiscard]] bool overlap(const Row& a, const Row& b) const;
  [[nodiscard]] bool asks(const Row& row, std::size_t field) const;
  [[nodiscard]] std::string option(const Row& row, std::span<const Row> later_rows) const;

  const std::vector<fsm::program::Term>* terms_;
  const fsm::program::Machine* machine_;
  std::vector<Row> rows_;
};

}  // namespace stormproof::promela
