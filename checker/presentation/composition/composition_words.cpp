// Triggers, conditions and effects in words; rules as programs.
#include "checker/presentation/composition/composition_words.hpp"

namespace stormproof::draw {

namespace comp = fsm::composition;

Glossary notation() {
  return {{"M <- E", "the machine M takes the event E; M.field is what it answers"},
          {"each M <- E", "the same for every descriptor"},
          {"S := value", "a flag or number"},
          {"T after delay, T at time", "the timer T is started; cancel T stops it"},
          {"emit P {…}", "the packet P is sent; what it does not say is false"},
          {"raise O", "the rules for O run here and now"},
          {"call N", "what several rules have in common; see the procedures"},
          {"perform N", "stated by a contract, done in a way of its own; see the steps"}};
}

Glossary owners() {
  return {{"participant", "each has one"},
          {"pair", "a participant and a peer"},
          {"writer", "a participant and one of its streams (pub, sub)"},
          {"relation", "a writer and one reader of it"},
          {"entry", "a descriptor of a writer, whoever reads it"},
          {"descriptor", "a descriptor of a writer towards one reader"},
          {"control relation", "a pair on a topic of which only the control traffic is modelled"},
          {"control writer", "a participant's writer on such a topic"}};
}

std::string_view verb(const comp::RuleInfo& rule) {
  if (rule.trigger == "received") return "is received";
  if (rule.trigger == "left") return "has left its source";
  if (rule.trigger == "due") return "is due";
  return "happens";
}

std::string trigger_words(const comp::RuleInfo& rule) {
  const std::string what = rule.trigger == "due" ? "the timer " : "";
  return "when " + what + std::string{rule.cause} + " " + std::string{verb(rule)};
}

std::string condition_words(const comp::EffectInfo& effect) {
  std::string words;
  for (const comp::BlockInfo& block : effect.blocks) {
    words += (words.empty() ? "" : "; ") + block.text;
  }
  return words;
}

std::string sentence(const comp::EffectInfo& effect) {
  const std::string target{effect.target};
  const std::string& detail = effect.detail;
  if (effect.kind == "feed") return target + " <- " + detail;
  if (effect.kind == "feed each") return "each " + target + " <- " + detail;
  if (effect.kind == "set") return target + " := " + detail;
  if (effect.kind == "set each") return "each " + target + " := " + detail;
  if (effect.kind == "after" || effect.kind == "at") {
    return target + " " + std::string{effect.kind} + " " + detail;
  }
  std::string text{effect.kind};
  text += " " + target;
  if (detail.empty()) return text;
  return text + (effect.kind == "emit" ? " {" + detail + "}" : " (" + detail + ")");
}

std::string_view number_of(const comp::EffectInfo& effect) {
  return std::string_view{effect.id}.substr(effect.id.rfind('.'));
}

std::vector<ProgramLine> program(const comp::RuleInfo& rule) {
  std::vector<ProgramLine> lines;
  std::vector<comp::BlockInfo> open;
  for (const comp::EffectInfo& effect : rule.effects) {
    std::size_t shared = 0;
    while (shared < open.size() && shared < effect.blocks.size() &&
           open[shared].number == effect.blocks[shared].number) {
      ++shared;
    }
    open = effect.blocks;
    for (std::size_t k = shared; k < open.size(); ++k) {
      lines.push_back({k, open[k].text + ":", nullptr});
    }
    lines.push_back({open.size(), sentence(effect), &effect});
  }
  return lines;
}

}  // namespace stormproof::draw
