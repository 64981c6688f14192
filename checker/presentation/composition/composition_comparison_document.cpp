// A comparison as a page: how much is the same, then what is not.
#include <fmt/format.h>

#include "checker/presentation/composition/composition_comparison.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::draw {

namespace {

using Is = RuleComparison::Is;
using report::Section;
using report::Text;

std::string title_of(const RuleComparison& rule) { return rule.group + " " + rule.id; }

report::Blocks differences(const CompositionComparison& comparison, const RuleComparison& rule) {
  report::Facts facts;
  if (!rule.triggers.empty()) facts.rows.emplace_back("trigger", rule.triggers);
  for (const EffectDifference& effect : rule.effects) {
    if (effect.second.empty()) {
      facts.rows.emplace_back("only " + comparison.first,
                              fmt::format("{}  {}", effect.first, effect.first_words));
    } else if (effect.first.empty()) {
      facts.rows.emplace_back("only " + comparison.second,
                              fmt::format("{}  {}", effect.second, effect.second_words));
    } else if (effect.first_words == effect.second_words) {
      facts.rows.emplace_back("in another order", fmt::format("{} / {}  {}", effect.first,
                                                              effect.second, effect.first_words));
    } else {
      facts.rows.emplace_back(comparison.first,
                              fmt::format("{}  {}", effect.first, effect.first_words));
      facts.rows.emplace_back(comparison.second,
                              fmt::format("{}  {}", effect.second, effect.second_words));
    }
  }
  return {std::move(facts)};
}

Section different(const CompositionComparison& comparison) {
  Section section{"In both, but different"};
  for (const RuleComparison& rule : comparison.rules) {
    if (rule.is != Is::different) continue;
    section.blocks.push_back(Section{title_of(rule), "", differences(comparison, rule)});
  }
  return section;
}

Section relying(const CompositionComparison& comparison) {
  report::Facts facts;
  for (const RuleComparison& rule : comparison.rules) {
    if (rule.is == Is::relies)
      facts.rows.emplace_back(rule.id, fmt::format("{}", fmt::join(rule.relies_on, ", ")));
  }
  return {"The same words, but about what differs", "", {std::move(facts)}};
}

Section listed(const CompositionComparison& comparison, Is is, const std::string& title) {
  report::Facts facts;
  for (const RuleComparison& rule : comparison.rules) {
    if (rule.is != is) continue;
    facts.rows.emplace_back(title_of(rule),
                            is == Is::same ? "" : fmt::format("{} effects", rule.ids.size()));
  }
  return {title, "", {std::move(facts)}};
}

bool is_empty(const Section& section) {
  if (section.blocks.empty()) return true;
  const auto* facts = std::get_if<report::Facts>(&section.blocks.front().content);
  return facts != nullptr && facts->rows.empty();
}

}  // namespace

report::Document comparison_document(const CompositionComparison& comparison) {
  const auto count = [&](Is is) { return comparison.count("rule", is); };
  report::Document document;
  document.title = "stormproof draw composition --compare";
  document.answer = Text{fmt::format(
      "{} of {} rules are the same; {} more say the same about something that differs, {} are "
      "different, {} only in {}, {} only in {}.",
      count(Is::same), comparison.count("rule"), count(Is::relies), count(Is::different),
      count(Is::only_first), comparison.first, count(Is::only_second), comparison.second)};
  if (comparison.first == comparison.second) {
    document.elaboration =
        Text{fmt::format("Both profiles run the composition '{}'.", comparison.first)};
  }
  for (Section section : {different(comparison), relying(comparison),
                          listed(comparison, Is::only_first, "Only in " + comparison.first),
                          listed(comparison, Is::only_second, "Only in " + comparison.second),
                          listed(comparison, Is::same, "The same")}) {
    if (!is_empty(section)) document.blocks.push_back(std::move(section));
  }
  if (!comparison.things.empty()) {
    report::Bullets bullets;
    for (const std::string& thing : comparison.things) bullets.items.emplace_back(thing);
    document.blocks.push_back(Section{"What there is", "", {std::move(bullets)}});
  }
  return document;
}

template <class V>
void describe(V& v, const EffectDifference& effect) {
  v.or_null("first", effect.first);
  v.or_null("second", effect.second);
  v.or_null("first_words", effect.first_words);
  v.or_null("second_words", effect.second_words);
}

template <class V>
void describe(V& v, const RuleComparison& rule) {
  v("id", rule.id);
  v("group", rule.group);
  v("comparison", rule.is);
  v.unless_empty("relies_on", rule.relies_on);
  v.unless_empty("triggers", rule.triggers);
  v.unless_empty("differences", rule.effects);
  v.unless_empty("effects", rule.ids);
}

template <class V>
void describe(V& v, const CompositionComparison& comparison) {
  v("first", comparison.first);
  v("second", comparison.second);
  v("rules", comparison.count("rule"));
  v("same", comparison.count("rule", Is::same));
  v("comparisons", comparison.rules);
  v("things", comparison.things);
}

nlohmann::ordered_json comparison_json(const CompositionComparison& comparison) {
  return report::json_of(comparison);
}

nlohmann::ordered_json comparison_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<CompositionComparison>(definitions);
}

}  // namespace stormproof::draw
