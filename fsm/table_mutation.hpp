// A deliberate mistake in one transition table. `stormproof mutate` applies plausible mistakes to
// the reflected tables and looks which property notices: a check that no mistake can upset proves
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace stormproof::fsm {

struct TableMutation {
  enum class Kind : std::uint8_t {
    drop_row,      ///< the row is missing
    retarget,      ///< the row leads to `target`
    negate_guard,  ///< the row fires when its guard is false
    ignore_guard,  ///< the row fires whatever its guard says
    drop_action,   ///< the row asks for nothing
    copy_row       ///< the row exists in state `source`, too, and leads to `target` from there
  };
  std::string machine;  ///< name of the machine, `MachineInfo::name`
  std::size_t row = 0;  ///< position in the table, `MachineInfo::rows`
  Kind kind{};
  std::uint8_t source = 0;  ///< of `copy_row`
  std::uint8_t target = 0;  ///< of `retarget` and `copy_row`
};

}  // namespace stormproof::fsm
