// How a composition is said, the same in every format.
#pragma once

#include <string>

#include "fsm/composition/composition_info.hpp"

namespace stormproof::draw {

/// "when AckNack is received": the trigger of a rule.
[[nodiscard]] std::string trigger_words(const fsm::composition::RuleInfo& rule);

/// "if WriterOpen; for each open reader": the blocks around an effect; empty: always.
[[nodiscard]] std::string condition_words(const fsm::composition::EffectInfo& effect);

}  // namespace stormproof::draw
