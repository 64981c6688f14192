// Mistakes for the explorer to find, by the names of what they are in.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "checker/engines/bounds/check_request.hpp"
#include "fsm/reflect.hpp"

namespace stormproof::explorer {

/// Number of the row of `Machine` with these states and event.
template <class Machine>
std::size_t row(std::string_view source, std::string_view event, std::string_view target) {
  const fsm::MachineInfo info = fsm::Reflect<Machine>::info();
  for (std::size_t k = 0; k < info.rows.size(); ++k) {
    const fsm::RowInfo& r = info.rows[k];
    if (info.states[r.source] == source && info.events[r.event] == event &&
        info.states[r.target] == target) {
      return k;
    }
  }
  ADD_FAILURE() << "no such row: " << source << " " << event << " " << target;
  return 0;
}

inline checker::Mutant table(fsm::TableMutation mutation) {
  checker::Mutant mutant;
  mutant.rules.tables.push_back(std::move(mutation));
  return mutant;
}
inline checker::Mutant event(model::EventMutation mutation) {
  checker::Mutant mutant;
  mutant.rules.events.push_back(mutation);
  return mutant;
}

}  // namespace stormproof::explorer
