// The rows of a table as values that can be looked through, evaluated in any domain, and mutated.
// Boost.MSM executes the table as it is written; proofs evaluate it over solver expressions, and
// `stormproof mutate` needs versions of it with a mistake in them. All of these read the same
// reflected rows. Over `Plain`, an unmutated RowTable does what MSM does; tests/fsm checks that
// exhaustively.
#pragma once

#include <span>
#include <vector>

#include "fsm/reflect.hpp"
#include "fsm/row_mutation.hpp"

namespace stormproof::fsm {

template <class Machine, class D = Plain>
class RowTable {
 public:
  using Input = typename Machine::Io::template Input<D>;
  using Output = typename Machine::Io::template Output<D>;
  using Bool = typename D::Bool;

  struct Row {
    StateId source = 0;
    std::uint8_t event = 0;
    StateId target = 0;
    Bool (*guard)(const Input&) = nullptr;            ///< null: no guard
    void (*action)(const Input&, Output&) = nullptr;  ///< null: no action
    bool negated = false;
    RowId number = 0;  ///< in the table as written

    [[nodiscard]] Bool enabled(const Input& input) const {
      if (guard == nullptr) return Bool(!negated);
      return negated ? Bool(!guard(input)) : guard(input);
    }
    void ignore_guard() { guard = nullptr; }
    void drop_action() { action = nullptr; }
  };

  /// The table with the mutations that concern this machine.
  explicit RowTable(std::span<const TableMutation> mutations = {}) {
    add_rows(typename Reflect<Machine>::Rows{});
    fsm::mutate(rows_, name_of<Machine>(), mutations);
  }

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

 private:
  template <class... Rs>
  void add_rows(TypeList<Rs...>) {
    (add_row<Rs>(), ...);
  }

  template <class R>
  void add_row() {
    using Info = Reflect<Machine>;
    Row row;
    row.number = static_cast<RowId>(rows_.size());
    row.source = Info::template id<typename R::Source>;
    row.event = Info::template event_id<typename R::Evt>;
    row.target = Info::template id<typename R::Target>;
    if constexpr (!std::is_same_v<typename R::Guard, none>) {
      row.guard = [](const Input& in) -> Bool { return R::Guard::template test<D>(in); };
    }
    if constexpr (!std::is_same_v<typename R::Action, none>) {
      row.action = [](const Input& in, Output& out) { R::Action::template act<D>(in, out); };
    }
    rows_.push_back(row);
  }

  std::vector<Row> rows_;
};

/// What one event did to one machine.
struct StepResult {
  StateId state = 0;
  RowId row = no_row;  ///< the row that fired, or the one that it is a copy of

  [[nodiscard]] bool fired() const { return row != no_row; }
};

/// Executes a table over plain values, in place of MSM, so that it can be a mutated one. Of two
/// enabled rows the later one wins, as in MSM.
template <class Machine>
class TableInterpreter {
 public:
  using Table = RowTable<Machine, Plain>;

  explicit TableInterpreter(std::span<const TableMutation> mutations = {}) : table_{mutations} {}

  StepResult step(StateId state, std::uint8_t event, const typename Table::Input& input,
                  typename Table::Output& output) const {
    const auto& rows = table_.rows();
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
      if (row->source != state || row->event != event || !row->enabled(input)) continue;
      if (row->action != nullptr) row->action(input, output);
      return {row->target, row->number};
    }
    return {state, no_row};
  }

 private:
  Table table_;
};

}  // namespace stormproof::fsm
