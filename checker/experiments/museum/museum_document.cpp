// The museum as a list, and an exhibit as a story: what it was, the knobs and rules that differ,
// the shortest counterexample, the repair and what it establishes, and what does not repair it.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "checker/experiments/museum/claims.hpp"
#include "checker/experiments/museum/museum.hpp"
#include "checker/presentation/document/verdicts.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/time_text.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "checker/verification/counterexample/stepper.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::museum {

using report::Bullets;
using report::code;
using report::Column;
using report::Document;
using report::Facts;
using report::Paragraph;
using report::Section;
using report::Table;
using report::Text;
using report::Tone;

namespace {

/// "stormproof museum E3".
std::string command_of(const std::string& id) {
  return report::command_line({"museum"}) + (id.empty() ? "" : " " + id);
}

std::string text_of(const Changes& changes) {
  std::vector<std::string> words;
  for (const auto& [key, value] : changes) words.push_back(key + "=" + value);
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Every key that some variant sets, with what each makes of it.
Table changed_knobs(const Exhibit& exhibit) {
  Table table;
  table.columns = {{"knob"}, {"before"}, {"after"}};
  std::vector<std::string> keys;
  for (const Changes* changes : {&exhibit.before.changes, &exhibit.after.changes}) {
    for (const auto& [key, value] : *changes) {
      if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    }
  }
  const auto value_in = [](const Changes& changes, const std::string& key) {
    const auto found = std::ranges::find(changes, key, &std::pair<std::string, std::string>::first);
    return found == changes.end() ? Text{"as in the scenario"} : code(found->second);
  };
  for (const std::string& key : keys) {
    table.rows.push_back(
        {{code(key), value_in(exhibit.before.changes, key), value_in(exhibit.after.changes, key)}});
  }
  return table;
}

/// The shortest run that breaks the claim: a story at a terminal, a chart elsewhere.
void add_counterexample(report::Blocks& blocks, const Found& found, const std::string& id,
                        std::set<std::string>& machines) {
  if (!found.counterexample) return;
  report::Sequence sequence = counterexample::walk(
      *found.counterexample, counterexample::chart_of(*found.counterexample), "chart-" + id,
      fmt::format("The shortest run that breaks {}", found.counterexample->property), machines);
  sequence.story = counterexample::told(*found.counterexample);
  blocks.emplace_back(std::move(sequence));
}

Facts facts_of(const Variant& variant, const Found& found) {
  Facts facts;
  facts.rows.emplace_back("verdict", report::badge(found.verdict));
  facts.rows.emplace_back("how", found.how);
  for (const std::string& sentence : found.assumptions) {
    facts.rows.emplace_back("assumes", sentence);
  }
  if (found.counterexample) facts.rows.emplace_back("why", found.counterexample->reason);
  if (found.latest) {
    facts.rows.emplace_back("latest completion", props::time_text(*found.latest));
  }
  if (found.verdict != variant.expected) {
    facts.rows.emplace_back("expected", report::badge(variant.expected));
  }
  return facts;
}

/// What it is, before, after and the decoys; `prefix` makes ids unique where there are several.
report::Blocks story_of(const ShownExhibit& shown, const std::string& prefix,
                        std::set<std::string>& machines) {
  report::Blocks blocks;
  const Exhibit& exhibit = shown.exhibit;
  const Claim& claim = *find_claim(exhibit.claim);

  Section what{"What it is"};
  what.blocks.emplace_back(Paragraph{exhibit.sentence});
  Facts facts;
  facts.rows.emplace_back("vendor", fmt::format("{}, {}", exhibit.vendor, exhibit.year));
  for (const std::string& link : exhibit.links) facts.rows.emplace_back("link", link);
  std::vector<std::string> rules;
  for (const std::string& rule : exhibit.rules) rules.push_back("§" + rule);
  facts.rows.emplace_back("rules", fmt::format("{}", fmt::join(rules, ", ")));
  facts.rows.emplace_back("property", code(claim.id) + Text{": " + std::string{claim.statement}});
  facts.rows.emplace_back("formally", std::string{claim.formal});
  if (exhibit.bound) facts.rows.emplace_back("bound B", props::time_text(*exhibit.bound));
  what.blocks.emplace_back(std::move(facts));
  what.blocks.emplace_back(changed_knobs(exhibit));
  blocks.emplace_back(std::move(what));

  Section before{"Before", prefix + "before"};
  before.blocks.emplace_back(facts_of(exhibit.before, shown.before));
  add_counterexample(before.blocks, shown.before, prefix + "before", machines);
  blocks.emplace_back(std::move(before));

  Section after{"After", prefix + "after"};
  after.blocks.emplace_back(Paragraph{exhibit.fix});
  after.blocks.emplace_back(facts_of(exhibit.after, shown.after));
  add_counterexample(after.blocks, shown.after, prefix + "after", machines);
  blocks.emplace_back(std::move(after));

  for (std::size_t k = 0; k < shown.decoys.size(); ++k) {
    const Variant& decoy = exhibit.decoys[k];
    const std::string id = fmt::format("{}decoy-{}", prefix, k);
    Section section{fmt::format("Instead: {}", decoy.title), id};
    section.blocks.emplace_back(Paragraph{code(text_of(decoy.changes))});
    section.blocks.emplace_back(facts_of(decoy, shown.decoys[k]));
    add_counterexample(section.blocks, shown.decoys[k], id, machines);
    blocks.emplace_back(std::move(section));
  }
  return blocks;
}

void append(report::Blocks& to, report::Blocks blocks) {
  for (report::Block& block : blocks) to.push_back(std::move(block));
}

/// One of them.
void tell(Document& document, const ShownExhibit& shown) {
  std::set<std::string> machines;
  append(document.blocks, story_of(shown, "", machines));
  if (!machines.empty()) {
    document.blocks.emplace_back(counterexample::diagrams_of(machines), report::Audience::page);
  }
}

/// Each of several, folded, on pages only: they have room for all charts.
void tell_all(Document& document, const Report& report) {
  std::set<std::string> machines;
  for (const ShownExhibit& shown : report.exhibits) {
    const std::string& id = shown.exhibit.id;
    Section section{fmt::format("{}: {}", id, shown.exhibit.title), id};
    section.blocks = story_of(shown, id + "-", machines);
    section.folded = true;
    document.blocks.emplace_back(std::move(section), report::Audience::page);
  }
  document.blocks.emplace_back(counterexample::diagrams_of(machines), report::Audience::page);
}

Table list_of(const Report& report) {
  Table table;
  Column defect{"defect"};
  defect.wraps = true;
  Column property{"property"};
  property.audience = report::Audience::verbose;
  Column vendor{"vendor"};
  vendor.wraps = true;
  table.columns = {{"id"},    vendor,    {"year", Column::Align::right},
                   defect,    property,  {"before"},
                   {"after"}, {"decoys"}};
  for (const ShownExhibit& shown : report.exhibits) {
    Text decoys;
    for (const Found& found : shown.decoys) {
      if (!decoys.empty()) decoys += " ";
      decoys += report::badge(found.verdict);
    }
    table.rows.push_back(
        {{code(shown.exhibit.id), shown.exhibit.vendor, fmt::format("{}", shown.exhibit.year),
          shown.exhibit.title, code(shown.exhibit.claim), report::badge(shown.before.verdict),
          report::badge(shown.after.verdict), decoys},
         !shown.as_expected()});
  }
  return table;
}

void judge(Document& document, const Report& report) {
  const auto wrong = std::ranges::count_if(
      report.exhibits, [](const ShownExhibit& shown) { return !shown.as_expected(); });
  document.complete = report.finished;
  if (!report.finished) {
    document.tone = Tone::warn;
    document.answer = "Interrupted; what is there holds.";
  } else if (wrong > 0) {
    document.tone = Tone::bad;
    document.answer =
        fmt::format("{} of {} exhibits {} not what {} said to be.", wrong, report.exhibits.size(),
                    wrong == 1 ? "is" : "are", wrong == 1 ? "it is" : "they are");
  } else if (report.exhibits.size() == 1) {
    document.tone = Tone::good;
    document.answer = fmt::format("{}: {} before, {} after.", report.exhibits.front().exhibit.title,
                                  name_of(report.exhibits.front().before.verdict),
                                  name_of(report.exhibits.front().after.verdict));
  } else {
    document.tone = Tone::good;
    document.answer = fmt::format(
        "{} defects of DDS implementations, each broken before and repaired after as it is said to "
        "be.",
        report.exhibits.size());
  }
}

}  // namespace

Document document_of(const Report& report, const std::string& reference) {
  Document document;
  document.title = "stormproof museum" + (reference.empty() ? "" : " " + reference);
  judge(document, report);
  if (!reference.empty() && report.exhibits.size() == 1) {
    tell(document, report.exhibits.front());
  } else {
    document.blocks.emplace_back(list_of(report));
    tell_all(document, report);
    document.next = {{command_of("E3"), "the story of one of them"}};
  }
  document.assumptions = {Text{
      "Bounded verdicts are about the scenario of the exhibit: its participants, delays and "
      "starts, and every pattern of so many lost packets among the first ones. They are no "
      "proofs for other deployments. Proved ones are about all deployments and losses, under what "
      "they assume, with the bound of the catalogue instead of that of the exhibit."}};
  return document;
}

}  // namespace stormproof::museum
