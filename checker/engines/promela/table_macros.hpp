// Writes the transition table of a descriptor machine as Promela macros, one for each event. The
// rows come from the reflected table and a guard is written as the list of inputs on which it
// holds, found by evaluating it, so that the model states no rule a second time.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <boost/pfr.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "fsm/row_table.hpp"

namespace stormproof::promela {

/// What an action asks for, by the name of the Promela variable that it sets.
using Requests = std::vector<std::pair<std::string, bool>>;

/// A machine all of whose inputs are truth values, so that its guards can be tabulated.
template <class Machine>
class TableMacros {
 public:
  using Table = fsm::RowTable<Machine>;
  using Input = typename Table::Input;
  using Output = typename Table::Output;

  /// `requests` names what an output asks for.
  TableMacros(std::span<const fsm::TableMutation> mutations, Requests (*requests)(const Output&))
      : table_{mutations}, requests_{requests}, info_{fsm::Reflect<Machine>::info()} {}

  /// `#define U 0` … for the states, then one macro `Event(d, in)` for each event. Bit k of `in` is
  /// the k-th input.
  [[nodiscard]] std::string text() const {
    std::string text;
    for (std::size_t s = 0; s < info_.states.size(); ++s) {
      text += fmt::format("#define {} {}\n", info_.states[s], s);
    }
    for (std::uint8_t event = 0; event < info_.events.size(); ++event) text += macro(event);
    return text;
  }

 private:
  using Row = typename Table::Row;
  static constexpr std::size_t input_count = boost::pfr::tuple_size_v<Input>;
  static constexpr unsigned combinations = 1U << input_count;

  static Input input(unsigned bits) {
    Input in;
    boost::pfr::for_each_field(in, [&](bool& field, std::size_t k) { field = bits >> k & 1U; });
    return in;
  }

  /// The inputs on which the row fires: those that enable it and no later row of its kind, which
  /// would win.
  [[nodiscard]] std::vector<unsigned> firing_inputs(std::size_t number) const {
    const auto& rows = table_.rows();
    std::vector<unsigned> firing;
    for (unsigned bits = 0; bits < combinations; ++bits) {
      const bool overruled = std::any_of(rows.begin() + static_cast<std::ptrdiff_t>(number) + 1,
                                         rows.end(), [&](const Row& later) {
                                           return later.source == rows[number].source &&
                                                  later.event == rows[number].event &&
                                                  later.enabled(input(bits));
                                         });
      if (!overruled && rows[number].enabled(input(bits))) firing.push_back(bits);
    }
    return firing;
  }

  [[nodiscard]] std::string macro(std::uint8_t event) const {
    std::string text = fmt::format("\ninline {}(d, in) {{\n  if\n", info_.events[event]);
    for (std::size_t k = 0; k < table_.rows().size(); ++k) {
      if (table_.rows()[k].event == event) text += option(k);
    }
    return text + "  :: else\n  fi\n}\n";
  }

  [[nodiscard]] std::string option(std::size_t number) const {
    const Row& row = table_.rows()[number];
    const std::vector<unsigned> firing = firing_inputs(number);
    if (firing.empty()) return "";
    std::string condition = fmt::format("state[d] == {}", info_.states[row.source]);
    if (firing.size() < combinations) {
      condition += fmt::format(" && (in == {})", fmt::join(firing, " || in == "));
    }
    std::string effect = fmt::format("state[d] = {}", info_.states[row.target]);
    Output output{};
    // An action of these machines only raises flags; it does not look at the input.
    if (row.action != nullptr) row.action(input(firing.front()), output);
    for (const auto& [name, wanted] : requests_(output)) {
      if (wanted) effect += fmt::format("; {}[d] = true", name);
    }
    return fmt::format("  :: {} -> {}\n", condition, effect);
  }

  Table table_;
  Requests (*requests_)(const Output&);
  fsm::MachineInfo info_;
};

}  // namespace stormproof::promela
