// How a composition is said, the same in every format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fsm/composition/composition_info.hpp"

namespace stormproof::draw {

/// Words of a composition, and what they mean.
using Glossary = std::vector<std::pair<std::string, std::string>>;
/// How effects are written.
[[nodiscard]] Glossary notation();
/// Who can have a machine, timer or rule.
[[nodiscard]] Glossary owners();

/// "is received", "has left its source", "is due", "happens": what a trigger does.
[[nodiscard]] std::string_view verb(const fsm::composition::RuleInfo& rule);

/// "when AckNack is received": the trigger of a rule.
[[nodiscard]] std::string trigger_words(const fsm::composition::RuleInfo& rule);

/// "if WriterOpen; for each open reader": the blocks around an effect; empty: always.
[[nodiscard]] std::string condition_words(const fsm::composition::EffectInfo& effect);

/// "C <- RepairDue", "RepairGeneration after NackResponseDelay": an effect without its condition.
[[nodiscard]] std::string sentence(const fsm::composition::EffectInfo& effect);

/// ".3": what follows the name of its rule in the id of an effect.
[[nodiscard]] std::string_view number_of(const fsm::composition::EffectInfo& effect);

/// A line of the program that a rule is: a condition that opens an indented block, or an effect.
struct ProgramLine {
  std::size_t depth = 0;  ///< how many blocks it stands in
  std::string text;       ///< "if Reader.opened:", or the sentence of the effect
  const fsm::composition::EffectInfo* effect = nullptr;  ///< none: a condition
};
[[nodiscard]] std::vector<ProgramLine> program(const fsm::composition::RuleInfo& rule);

}  // namespace stormproof::draw
