// The page of a composition: how to read it, what there is, what happens.
#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/composition/composition_graph.hpp"
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

constexpr std::size_t two_headings = 8;  ///< how far a listing below them is to the right

/// "one, two".
std::string or_dash(const std::vector<std::string>& names) {
  return names.empty() ? "–" : fmt::format("{}", fmt::join(names, ", "));
}

report::Facts facts(const Glossary& glossary) {
  report::Facts facts;
  for (const auto& [word, meaning] : glossary) facts.rows.emplace_back(word, meaning);
  return facts;
}

Section how_to_read() {
  return {"How to read it",
          "",
          {report::Paragraph{
               "Machines do not know each other. A rule says what happens between them: its "
               "trigger, whose it is, and effects, one after the other. At the right margin stands "
               "the id of each effect."},
           facts(notation())}};
}

Section machines(const CompositionInfo& composition) {
  Table table{{{"name"}, {"machine"}, {"of each"}, {"fed by", {}, true}}, {}};
  for (const comp::PartInfo& part : composition.parts) {
    table.rows.push_back({{part.name, part.machine, part.owner,
                           or_dash(causes_of(composition, part.name, {"feed", "feed each"}))}});
  }
  return {"Machines", "", {std::move(table)}};
}

Section packets(const CompositionInfo& composition) {
  Table table{{{"packet"}, {"of each"}, {"sent by", {}, true}, {"triggers", {}, true}}, {}};
  for (const comp::ThingInfo& packet : composition.packets) {
    table.rows.push_back(
        {{packet.name, packet.owner, or_dash(causes_of(composition, packet.name, {"emit"})),
          or_dash(handlers_of(composition, packet.name))}});
  }
  return {"Packets", "", {std::move(table)}};
}

Section timers(const CompositionInfo& composition) {
  Table table{{{"timer"}, {"of each"}, {"started by", {}, true}, {"triggers", {}, true}}, {}};
  for (const comp::ThingInfo& timer : composition.timers) {
    table.rows.push_back(
        {{timer.name, timer.owner, or_dash(causes_of(composition, timer.name, {"after", "at"})),
          or_dash(handlers_of(composition, timer.name))}});
  }
  return {"Timers", "", {std::move(table)}};
}

Section state(const CompositionInfo& composition) {
  Table table{{{"state"}, {"of each"}, {"set by", {}, true}}, {}};
  for (const comp::ThingInfo& state : composition.state) {
    table.rows.push_back({{state.name, state.owner,
                           or_dash(causes_of(composition, state.name, {"set", "set each"}))}});
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
report::Listing program_listing(const RuleInfo& rule, std::size_t columns) {
  std::size_t margin = 0;
  for (const EffectInfo& effect : rule.effects) margin = std::max(margin, effect.id.size());
  const std::size_t width = columns - two_headings - margin - 2;
  std::string text;
  for (const ProgramLine& line : program(rule)) {
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

Section programs(const char* title, const char* about, const std::vector<RuleInfo>& rules,
                 std::size_t columns) {
  Section section{title};
  if (*about != '\0') section.blocks.push_back(report::Paragraph{about});
  for (const RuleInfo& rule : rules) {
    const std::string when =
        rule.trigger.empty() ? "" : fmt::format(": {} ({})", trigger_words(rule), rule.owner);
    section.blocks.push_back(Section{rule.id + when, "", {program_listing(rule, columns)}});
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

Section from_outside(const CompositionInfo& composition) {
  report::Facts facts;
  for (const comp::FromOutsideInfo& cause : composition.from_outside) {
    facts.rows.emplace_back(std::string{cause.name}, cause.reason);
  }
  return {"What comes from outside", "", {std::move(facts)}};
}

}  // namespace

report::Document composition_document(const CompositionInfo& composition, std::size_t columns) {
  report::Document document;
  document.title = fmt::format("stormproof draw composition: {}", composition.name);
  document.answer =
      Text{fmt::format("The composition '{}': {} machines, {} packets, {} timers, "
                       "{} rules",
                       composition.name, composition.parts.size(), composition.packets.size(),
                       composition.timers.size(), composition.rules.size())};
  document.blocks = {
      how_to_read(),
      Section{"Whose it is", "", {facts(owners())}},
      machines(composition),
      packets(composition),
      timers(composition),
      state(composition),
      programs("Rules", "", composition.rules, columns),
      programs("Procedures", "What several rules have in common.", composition.procedures, columns),
      programs("Steps", "Their contracts: what they may do.", composition.steps, columns)};
  if (!composition.unused.empty()) document.blocks.push_back(unused(composition));
  if (!composition.from_outside.empty()) document.blocks.push_back(from_outside(composition));
  return document;
}

}  // namespace stormproof::draw
