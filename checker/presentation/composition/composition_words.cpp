// Triggers and conditions in words.
#include "checker/presentation/composition/composition_words.hpp"

namespace stormproof::draw {

std::string trigger_words(const fsm::composition::RuleInfo& rule) {
  const std::string cause{rule.cause};
  if (rule.trigger == "received") return "when " + cause + " is received";
  if (rule.trigger == "left") return "when " + cause + " has left its source";
  if (rule.trigger == "due") return "when the timer " + cause + " is due";
  return "when " + cause + " happens";
}

std::string condition_words(const fsm::composition::EffectInfo& effect) {
  std::string words;
  for (const fsm::composition::BlockInfo& block : effect.blocks) {
    words += (words.empty() ? "" : "; ") + block.text;
  }
  return words;
}

}  // namespace stormproof::draw
