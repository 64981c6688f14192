// What a mistake in a table (fsm/table_mutation.hpp) does to its rows, whatever guards and actions
// are in them: functions that are executed (fsm/row_table.hpp), or terms (fsm/program).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "fsm/table_mutation.hpp"

namespace stormproof::fsm {

/// Makes the mistakes that concern this machine in all of its rows. `Mutations`: a range.
template <class Row, class Mutations>
void mutate(std::vector<Row>& rows, std::string_view machine, const Mutations& mutations) {
  using Kind = TableMutation::Kind;
  constexpr std::uint8_t dropped = UINT8_MAX;  // rows are numbered as written: removals come last
  for (const TableMutation& mutation : mutations) {
    if (mutation.machine != machine) continue;
    Row& row = rows.at(mutation.row);
    switch (mutation.kind) {
      case Kind::drop_row:
        row.source = dropped;
        break;
      case Kind::retarget:
        row.target = mutation.target;
        break;
      case Kind::negate_guard:
        row.negated = !row.negated;
        break;
      case Kind::ignore_guard:
        row.ignore_guard();
        break;
      case Kind::drop_action:
        row.drop_action();
        break;
      case Kind::copy_row: {
        Row copy = row;
        copy.source = mutation.source;
        copy.target = mutation.target;
        rows.push_back(copy);
        break;
      }
    }
  }
  std::erase_if(rows, [](const Row& row) { return row.source == dropped; });
}

}  // namespace stormproof::fsm
