// One step of a machine over solver expressions: from which state, on which input, to which states
// and with which outputs. A state is a list of truth values, one per state of the machine, exactly
// one of which holds; that keeps invariants readable. Of two enabled rows the later one wins, as in
// Boost.MSM, so that mutated tables mean what they mean in a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <boost/pfr.hpp>

#include "checker/engines/tables/proof.hpp"
#include "fsm/program/program.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::tables {

/// One truth value per state number.
using OneHot = Exprs;

/// Exactly one of the values holds.
[[nodiscard]] Expr exactly_one(const OneHot& state);

/// The states after an event. Of its rows, the last one of the table first, `enabled(row)` says
/// when the guard holds, and `fire(row, when)` hears when the row fires.
template <class Row, class Enabled, class Fire>
OneHot states_after(const std::vector<Row>& rows, std::uint8_t event, const OneHot& state,
                    const Expr& when, Enabled&& enabled, Fire&& fire) {
  std::vector<Exprs> entered(state.size());
  std::vector<Exprs> left(state.size());
  std::vector<Exprs> later(state.size());  // rows that come later in the table and so win
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    if (row->event != event) continue;
    const Expr can = when && state[row->source] && enabled(*row);
    const Expr fires = (can && !any_of(later[row->source])).simplify();
    later[row->source].push_back(can);
    left[row->source].push_back(fires);
    entered[row->target].push_back(fires);
    fire(*row, fires);
  }
  OneHot next;
  for (std::size_t k = 0; k < state.size(); ++k) {
    next.push_back((any_of(entered[k]) || (state[k] && !any_of(left[k]))).simplify());
  }
  return next;
}

/// What several rows ask for of one field: the first value is that of an empty outbox.
inline Expr merged(const Expr& total, const Expr& one, const Expr& fires) {
  if (total.is_bool()) return (total || (fires && one)).simplify();
  return z3::ite(fires, one, total).simplify();
}

/// One step of a recorded machine. `value_of` evaluates a term over the input.
struct RecordedStep {
  OneHot next;
  Exprs outbox;  ///< by field

  template <class ValueOf>
  RecordedStep(const fsm::program::Machine& machine,
               const std::vector<fsm::program::Machine::Row>& rows, std::uint8_t event,
               const OneHot& state, const Expr& when, ValueOf&& value_of) {
    using fsm::program::no_term;
    for (const fsm::program::Machine::Field& field : machine.outputs) {
      const bool is_truth = field.sort == fsm::program::Sort::truth;
      outbox.push_back(is_truth ? smt::SymbolicBool{}.expr() : smt::SymbolicInt{}.expr());
    }
    const Exprs nothing = outbox;
    const auto enabled = [&](const auto& row) {
      const Expr holds =
          row.guard == no_term ? smt::SymbolicBool{true}.expr() : value_of(row.guard);
      return row.negated ? !holds : holds;
    };
    std::vector<std::pair<Expr, Exprs>> fired;
    next = states_after(rows, event, state, when, enabled, [&](const auto& row, const Expr& fires) {
      Exprs asked = nothing;
      for (std::size_t k = 0; k < asked.size(); ++k) {
        if (row.out[k] != no_term) asked[k] = value_of(row.out[k]);
      }
      fired.emplace_back(fires, std::move(asked));
    });
    for (const auto& [fires, asked] : fired) {
      for (std::size_t k = 0; k < asked.size(); ++k) {
        outbox[k] = merged(outbox[k], asked[k], fires);
      }
    }
  }
};

template <class Machine>
class MachineStep {
 public:
  using Table = fsm::RowTable<Machine, smt::Symbolic>;
  using Input = typename Table::Input;
  using Output = typename Table::Output;

  /// What one event does.
  struct Effect {
    OneHot next;
    std::vector<std::pair<Expr, Output>> fired;  ///< when each row fires, and what it then asks for

    /// A truth value of the outbox; false if no row fires.
    [[nodiscard]] Expr asks(smt::SymbolicBool Output::*field) const {
      Exprs cases;
      for (const auto& [fires, output] : fired) cases.push_back(fires && (output.*field).expr());
      return any_of(cases).simplify();
    }
    /// Some row fires.
    [[nodiscard]] Expr fires() const {
      Exprs cases;
      for (const auto& row : fired) cases.push_back(row.first);
      return any_of(cases);
    }
    /// What is asked for in all: an empty outbox if no row fires.
    [[nodiscard]] Output outbox() const {
      Output total;
      for (const auto& [when, asked] : fired) {
        [&total, &fires = when, &one = asked ]<std::size_t... I>(std::index_sequence<I...>) {
          (merge(boost::pfr::get<I>(total), boost::pfr::get<I>(one), fires), ...);
        }
        (std::make_index_sequence<boost::pfr::tuple_size_v<Output>>{});
      }
      return total;
    }

   private:
    template <class Value>
    static void merge(Value& total, const Value& one, const Expr& fires) {
      total = Value{merged(total.expr(), one.expr(), fires)};
    }
  };

  explicit MachineStep(const std::vector<fsm::TableMutation>& mutations) : table_{mutations} {}

  static constexpr std::size_t states = fsm::Reflect<Machine>::state_count;

  /// Unknown truth values named "<prefix><state>".
  [[nodiscard]] static OneHot unknown_state(const std::string& prefix) {
    OneHot state;
    for (const std::string_view name : fsm::Reflect<Machine>::state_names) {
      state.push_back(smt::SymbolicBool::named(prefix + std::string{name}).expr());
    }
    return state;
  }

  /// Each value says whether the state is the initial one.
  [[nodiscard]] static Expr is_initial(const OneHot& state) {
    const auto initial = fsm::Reflect<Machine>::template id<typename Machine::initial_state>;
    Exprs parts;
    for (std::size_t k = 0; k < state.size(); ++k) {
      parts.push_back(k == initial ? state[k] : !state[k]);
    }
    return all_of(parts);
  }

  /// `Event` in `state`, provided that `when` holds.
  template <class Event>
  [[nodiscard]] Effect step(const OneHot& state, const Input& input, const Expr& when) const {
    const auto event = fsm::Reflect<Machine>::template event_id<Event>;
    const auto& rows = table_.rows();
    const auto enabled = [&](const auto& row) { return row.enabled(input).expr(); };
    Effect effect;
    effect.next =
        states_after(rows, event, state, when, enabled, [&](const auto& row, const Expr& fires) {
          Output output;
          if (row.action != nullptr) row.action(input, output);
          effect.fired.emplace_back(fires, output);
        });
    return effect;
  }

 private:
  Table table_;
};

}  // namespace stormproof::tables
