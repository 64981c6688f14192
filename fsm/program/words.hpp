// A program in words: what pages, pictures, checks of completeness and mutants read
// (fsm/composition/composition_info.hpp).
#pragma once

#include "fsm/composition/composition_info.hpp"
#include "fsm/program/program.hpp"

namespace stormproof::fsm::program {

[[nodiscard]] composition::CompositionInfo words_of(const Program& program);

}  // namespace stormproof::fsm::program
