// Writes the transition table of a machine as Promela macros, one for each event:
//   inline DescriptorRepair_AckNackReceived(state, d, Listed, Confirmed)
// The rows come from the reflected table. What a guard tests is an argument, by the guard's name:
// the rule that feeds the event says what holds there, with the guard's own body over expressions,
// so that the model states no rule a second time. What a row asks for are bits of an outbox, bit d
// for descriptor d.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include <boost/pfr.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "checker/engines/promela/expression.hpp"
#include "fsm/composition/outbox.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::promela {

namespace detail {

/// A guard as a formula over the named guards that it consists of, its leaves.
template <class G>
struct Formula {
  using Leaves = fsm::TypeList<G>;
  static Truth of(auto&& leaf) { return leaf(fsm::name_of<G>()); }
};
template <>
struct Formula<fsm::none> {
  using Leaves = fsm::TypeList<>;
  static Truth of(auto&&) { return true; }
};
template <class G>
struct Formula<fsm::Not<G>> {
  using Leaves = typename Formula<G>::Leaves;
  static Truth of(auto&& leaf) { return !Formula<G>::of(leaf); }
};
template <class... Gs>
struct Formula<fsm::All<Gs...>> {
  using Leaves = fsm::composition::Joined<typename Formula<Gs>::Leaves...>;
  static Truth of(auto&& leaf) { return (Formula<Gs>::of(leaf) && ...); }
};

}  // namespace detail

template <class Machine>
class TableMacros {
 public:
  using Of = Machine;
  using Io = typename Machine::Io;

  explicit TableMacros(std::span<const fsm::TableMutation> mutations)
      : table_{mutations}, info_{fsm::Reflect<Machine>::info()} {}

  [[nodiscard]] static std::string state(std::string_view name) {
    return fmt::format("{}_{}", fsm::name_of<Machine>(), name);
  }
  [[nodiscard]] static std::string outbox(std::size_t field) {
    return fmt::format("{}_{}", fsm::name_of<Machine>(), fsm::composition::outbox_names<Io>[field]);
  }
  [[nodiscard]] std::string name(std::uint8_t event) const {
    return fmt::format("{}_{}", info_.name, info_.events[event]);
  }
  /// What the guards of the event's rows find on this input, in the order of the macro's arguments.
  template <class Event>
  [[nodiscard]] std::vector<Truth> findings(const typename Io::template Input<Written>& in) const {
    std::vector<Truth> all;
    std::vector<std::string_view> names;
    for_each_leaf(fsm::Reflect<Machine>::template event_id<Event>, [&]<class G>() {
      if (add_unique(names, fsm::name_of<G>())) all.push_back(G::template test<Written>(in));
    });
    return all;
  }
  /// Whether some row of the event asks for this field of the outbox.
  [[nodiscard]] bool asks(std::uint8_t event, std::size_t field) const {
    return std::ranges::any_of(table_.rows(), [&](const Row& row) {
      return row.event == event && std::ranges::count(asked(row), outbox(field)) != 0;
    });
  }

  /// `#define DescriptorRepair_U 0` … for the states.
  [[nodiscard]] static std::string states() {
    std::string text;
    unsigned number = 0;
    for (const std::string_view each : fsm::Reflect<Machine>::state_names) {
      text += fmt::format("#define {} {}\n", state(each), number++);
    }
    return text;
  }
  [[nodiscard]] std::string macro(std::uint8_t event) const {
    std::vector<std::string_view> arguments{"state", "d"};
    for_each_leaf(event, [&]<class G>() { add_unique(arguments, fsm::name_of<G>()); });
    std::string text =
        fmt::format("inline {}({}) {{\n  if\n", name(event), fmt::join(arguments, ", "));
    const auto& rows = table_.rows();
    for (auto row = rows.begin(); row != rows.end(); ++row) {
      if (row->event == event) text += option(*row, {row + 1, rows.end()});
    }
    return text + "  :: else\n  fi\n}\n";
  }

 private:
  using Table = fsm::RowTable<Machine, Written>;
  using Row = typename Table::Row;

  static bool add_unique(std::vector<std::string_view>& names, std::string_view name) {
    if (std::ranges::find(names, name) != names.end()) return false;
    names.push_back(name);
    return true;
  }
  template <class Visit>
  static void for_each_leaf(std::uint8_t event, Visit&& visit) {
    fsm::composition::for_each_type(typename fsm::Reflect<Machine>::Rows{}, [&]<class R>() {
      if (fsm::Reflect<Machine>::template event_id<typename R::Evt> != event) return;
      fsm::composition::for_each_type(typename detail::Formula<typename R::Guard>::Leaves{}, visit);
    });
  }
  /// The row's guard, with what `leaf` says of each of its leaves.
  template <class Leaf>
  static Truth guard(const Row& row, Leaf leaf) {
    Truth holds = true;
    unsigned number = 0;
    if (row.guard != nullptr) {
      fsm::composition::for_each_type(typename fsm::Reflect<Machine>::Rows{}, [&]<class R>() {
        if (number++ == row.number) holds = detail::Formula<typename R::Guard>::of(leaf);
      });
    }
    return row.negated ? !holds : holds;
  }
  /// Whether both guards can hold at once, as far as their formulas tell.
  static bool overlap(const Row& a, const Row& b) {
    std::vector<std::string_view> leaves;
    for_each_leaf(a.event, [&]<class G>() { add_unique(leaves, fsm::name_of<G>()); });
    for (unsigned bits = 0; bits < 1U << leaves.size(); ++bits) {
      const auto leaf = [&](std::string_view name) -> Truth {
        return (bits >> (std::ranges::find(leaves, name) - leaves.begin()) & 1U) != 0;
      };
      if ((guard(a, leaf) && guard(b, leaf)).is(true)) return true;
    }
    return false;
  }
  /// The fields that the row's action raises. No action of a machine looks at truth values.
  static std::vector<std::string> asked(const Row& row) {
    std::vector<std::string> fields;
    typename Table::Output output{};
    if (row.action != nullptr) row.action({}, output);
    boost::pfr::for_each_field(output, [&](const auto& field, std::size_t k) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, Truth>) {
        if (!field.is(false)) fields.push_back(outbox(k));
      }
    });
    return fields;
  }
  /// Of two rows that are enabled the later one wins.
  [[nodiscard]] std::string option(const Row& row, std::span<const Row> later_rows) const {
    const auto leaf = [](std::string_view name) { return Truth{Expression{std::string{name}}}; };
    Truth fires = guard(row, leaf);
    for (const Row& later : later_rows) {
      if (later.source == row.source && later.event == row.event && overlap(row, later)) {
        fires = fires && !guard(later, leaf);
      }
    }
    if (fires.is(false)) return "";
    std::string text = fmt::format("  :: state == {}", state(info_.states[row.source]));
    if (!fires.is(true)) text += " && " + fires.expression().text;
    text += fmt::format(" -> state = {}", state(info_.states[row.target]));
    for (const std::string& field : asked(row)) {
      text += fmt::format("; {0} = {0} | (1 << d)", field);
    }
    return text + "\n";
  }

  Table table_;
  fsm::MachineInfo info_;
};

}  // namespace stormproof::promela
