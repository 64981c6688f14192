// The page of a composition: how to read it, what there is, what happens.
#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::draw {

namespace {

namespace comp = fsm::composition;
using comp::CompositionInfo;
using comp::EffectInfo;
using comp::RuleInfo;
using report::Section;
using report::Table;
using report::Text;

constexpr std::size_t program_width = 92;  ///< of a listing, below two headings

/// "one, two".
class Names {
 public:
  void add(const std::string& name) {
    if (known_.insert(name).second) text_ += (text_.empty() ? "" : ", ") + name;
  }
  [[nodiscard]] std::string text() const { return text_.empty() ? "–" : text_; }

 private:
  std::set<std::string> known_;
  std::string text_;
};

/// The rules, procedures and steps with an effect of such a kind on `target`.
std::string causes(const CompositionInfo& composition, std::string_view target,
                   std::initializer_list<std::string_view> kinds) {
  Names names;
  for (const auto* rules : {&composition.rules, &composition.procedures, &composition.steps}) {
    for (const RuleInfo& rule : *rules) {
      for (const EffectInfo& effect : rule.effects) {
        if (effect.target == target && std::ranges::find(kinds, effect.kind) != kinds.end()) {
          names.add(rule.id);
        }
      }
    }
  }
  return names.text();
}

/// The rules that this triggers.
std::string handlers(const CompositionInfo& composition, std::string_view cause) {
  Names names;
  for (const RuleInfo& rule : composition.rules) {
    if (rule.cause == cause) names.add(rule.id);
  }
  return names.text();
}

Section how_to_read() {
  return {"How to read it",
          "",
          {report::Paragraph{
               "Machines do not know each other. A rule says what happens between them: its "
               "trigger, whose it is, and effects, one after the other. At the right margin stands "
               "the id of each effect."},
           report::Facts{{{"M <- E", "the machine M takes the event E; M.field is what it answers"},
                          {"each M <- E", "the same for every descriptor"},
                          {"S := value", "a flag or number"},
                          {"T after delay, T at time", "the timer T is started; cancel T stops it"},
                          {"emit P {…}", "the packet P is sent; what it does not say is false"},
                          {"raise O", "the rules for O run here and now"},
                          {"call N", "what several rules have in common; see the procedures"},
                          {"perform N",
                           "stated by a contract, done in a way of its own; see the "
                           "steps"}}}}};
}

Section owners() {
  return {"Whose it is",
          "",
          {report::Facts{{{"participant", "each has one"},
                          {"pair", "a participant and a peer"},
                          {"writer", "a participant and one of its streams (pub, sub)"},
                          {"relation", "a writer and one reader of it"},
                          {"entry", "a descriptor of a writer, whoever reads it"},
                          {"descriptor", "a descriptor of a writer towards one reader"},
                          {"control relation",
                           "a pair on a topic of which only the control "
                           "traffic is modelled"}}}}};
}

Section machines(const CompositionInfo& composition) {
  Table table{{{"name"}, {"machine"}, {"of each"}, {"fed by", {}, true}}, {}};
  for (const comp::PartInfo& part : composition.parts) {
    table.rows.push_back({{part.name, part.machine, part.owner,
                           causes(composition, part.name, {"feed", "feed each"})}});
  }
  return {"Machines", "", {std::move(table)}};
}

Section packets(const CompositionInfo& composition) {
  Table table{{{"packet"}, {"of each"}, {"sent by", {}, true}, {"triggers", {}, true}}, {}};
  for (const comp::ThingInfo& packet : composition.packets) {
    table.rows.push_back({{packet.name, packet.owner, causes(composition, packet.name, {"emit"}),
                           handlers(composition, packet.name)}});
  }
  return {"Packets", "", {std::move(table)}};
}

Section timers(const CompositionInfo& composition) {
  Table table{{{"timer"}, {"of each"}, {"started by", {}, true}, {"triggers", {}, true}}, {}};
  for (const comp::ThingInfo& timer : composition.timers) {
    table.rows.push_back(
        {{timer.name, timer.owner, causes(composition, timer.name, {"after", "at"}),
          handlers(composition, timer.name)}});
  }
  return {"Timers", "", {std::move(table)}};
}

Section state(const CompositionInfo& composition) {
  Table table{{{"state"}, {"of each"}, {"set by", {}, true}}, {}};
  for (const comp::ThingInfo& state : composition.state) {
    table.rows.push_back(
        {{state.name, state.owner, causes(composition, state.name, {"set", "set each"})}});
  }
  report::Facts facts;
  for (const auto& [name, definition] : composition.facts) {
    facts.rows.emplace_back(name, definition);
  }
  return {"State outside the machines",
          "",
          {std::move(table), report::Paragraph{"What follows from the state:"}, std::move(facts)}};
}

/// The effects as a program, with their ids at the right margin.
report::Listing program_listing(const RuleInfo& rule) {
  std::size_t margin = 0;
  for (const EffectInfo& effect : rule.effects) margin = std::max(margin, effect.id.size());
  const std::size_t width = program_width - margin - 2;
  std::string text;
  for (const comp::ProgramLine& line : program(rule.effects)) {
    const std::string indent(2 * line.depth, ' ');
    const auto lines = report::wrapped(line.text, width, indent.size() + 4, indent);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      text += lines[k];
      if (k == 0 && line.effect != nullptr) {
        const std::size_t used = std::min(report::columns(lines[k]), width);
        const std::size_t right = margin - line.effect->id.size();
        text += std::string(width - used + 2 + right, ' ') + line.effect->id;
      }
      text += "\n";
    }
  }
  return {text.empty() ? "nothing\n" : text};
}

Section programs(const char* title, const char* about, const std::vector<RuleInfo>& rules) {
  Section section{title};
  if (*about != '\0') section.blocks.push_back(report::Paragraph{about});
  for (const RuleInfo& rule : rules) {
    const std::string when =
        rule.trigger.empty() ? "" : fmt::format(": {} ({})", trigger_words(rule), rule.owner);
    section.blocks.push_back(Section{rule.id + when, "", {program_listing(rule)}});
  }
  return section;
}

Section unused(const CompositionInfo& composition) {
  report::Facts facts;
  for (const comp::UnusedInfo& unused : composition.unused) {
    facts.rows.emplace_back(fmt::format("{}.{}", unused.part, unused.name), unused.reason);
  }
  return {"What no rule needs, and why", "", {std::move(facts)}};
}

}  // namespace

report::Document composition_document(const CompositionInfo& composition) {
  report::Document document;
  document.title = fmt::format("stormproof draw composition: {}", composition.name);
  document.answer =
      Text{fmt::format("The composition '{}': {} machines, {} packets, {} timers, "
                       "{} rules",
                       composition.name, composition.parts.size(), composition.packets.size(),
                       composition.timers.size(), composition.rules.size())};
  document.blocks = {
      how_to_read(),
      owners(),
      machines(composition),
      packets(composition),
      timers(composition),
      state(composition),
      programs("Rules", "", composition.rules),
      programs("Procedures", "What several rules have in common.", composition.procedures),
      programs("Steps", "Their contracts: what they may do.", composition.steps)};
  if (!composition.unused.empty()) document.blocks.push_back(unused(composition));
  return document;
}

}  // namespace stormproof::draw
