// What the fuzz targets have in common: how a failed check ends the program, where profiles that
// the input names are looked for, and what holds for every scenario that was accepted.
#pragma once

#include <string_view>

#include "model/config/spec_path.hpp"
#include "model/scenario.hpp"

namespace stormproof::fuzzing {

/// Ends the program with `law` on stderr if it does not hold.
void require(bool holds, std::string_view law);

/// The specs folder of the source tree.
[[nodiscard]] const model::config::SpecPath& specs();

/// Whether the input names a place from which reading may wait for ever or never end (a terminal, a
/// pipe): nothing that a reader could notice, and nothing for a fuzzer to touch.
[[nodiscard]] bool names_a_device(std::string_view input);

/// Whether the first events of the scenario take little time and memory.
[[nodiscard]] bool is_small(const model::Scenario& scenario);

/// An accepted scenario, written as JSON and as YAML, reads back as an equal one; if it is small,
/// its first events run.
void check_scenario(const model::Scenario& scenario);

}  // namespace stormproof::fuzzing
