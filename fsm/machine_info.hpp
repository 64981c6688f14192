// A machine as plain data. Diagrams, coverage lists and mutants read this, and need nothing of
// Boost.MSM for it; fsm/reflect.hpp makes it from a front end.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stormproof::fsm {

/// Number of a state in its machine; equals MSM's `get_state_id`.
using StateId = std::uint8_t;

/// One row of a table as data.
struct RowInfo {
  StateId source;
  std::uint8_t event;
  StateId target;
  std::string guard;        ///< the guard in words, "none" if there is none
  std::string_view action;  ///< name of the action, "none" if there is none
};

/// A whole machine as data: what diagrams, proofs and tests iterate over.
struct MachineInfo {
  std::string_view name;
  StateId initial;
  std::vector<std::string_view> states;  ///< by state number
  std::vector<std::string_view> events;  ///< by event number
  std::vector<RowInfo> rows;             ///< in table order
};

}  // namespace stormproof::fsm
