// A check as a document: whether it passes, the three questions that decide it, what fails and why,
// what the rules are known not to promise, what holds, and how each violation comes about.
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/document/unreached.hpp"
#include "checker/presentation/document/verdicts.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/check_answer.hpp"
#include "checker/verification/check/check_findings.hpp"
#include "checker/verification/check/check_report.hpp"
#include "checker/verification/check/frontier_document.hpp"
#include "checker/verification/check/next_steps.hpp"
#include "checker/verification/check/origins.hpp"
#include "checker/verification/check/run_plots.hpp"
#include "checker/verification/counterexample/stepper.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::checker {

namespace {

using props::VerdictKind;
using report::Audience;
using report::Block;
using report::Blocks;
using report::Bullets;
using report::Listing;
using report::Paragraph;
using report::Section;
using report::Table;
using report::Text;

/// "tables: no two rows …"
std::string method(const props::Finding& finding) {
  return finding.engine.empty() ? finding.how : finding.engine + ": " + finding.how;
}

/// Why it is violated, or how it was decided.
std::string sentence_of(const PropertyResult& result) {
  const props::Counterexample* counterexample = result.counterexample();
  return counterexample == nullptr ? method(result.decisive()) : counterexample->reason;
}

Blocks findings_at_terminal(const PropertyResult& result, const CheckContext& context) {
  Blocks blocks;
  const props::Finding& decisive = result.decisive();
  if (result.counterexample() != nullptr) {
    blocks.emplace_back(Paragraph{"by " + method(decisive)}, Audience::terminal);
  }
  blocks.emplace_back(
      Paragraph{statement_of(*result.property, model::kind_of(context.scenario.dds))},
      Audience::explained);
  Bullets assumptions;
  for (const std::string& one : decisive.assumptions) {
    assumptions.items.emplace_back("assuming " + one);
  }
  blocks.emplace_back(std::move(assumptions), Audience::terminal);
  std::string lines;
  for (const std::string& line : decisive.details) lines += line + "\n";
  if (!decisive.solver.empty()) {
    lines +=
        fmt::format("{}, seed {}, {:.3f} s\n", decisive.solver, decisive.seed, decisive.seconds);
  }
  blocks.emplace_back(Listing{lines}, Audience::explained);
  for (const props::Finding& other : result.findings) {
    if (&other == &decisive) continue;
    const bool open = !holds(result.verdict) && result.verdict != VerdictKind::violated;
    const Audience who = open ? Audience::terminal : Audience::explained;
    blocks.emplace_back(Paragraph{fmt::format("also {}, {}", name_of(other.kind), method(other))},
                        who);
    std::string more;
    for (const std::string& line : other.details) more += line + "\n";
    blocks.emplace_back(Listing{more}, who);
  }
  return blocks;
}

/// The findings of all engines.
Blocks findings_in_documents(const PropertyResult& result) {
  Blocks blocks;
  for (const props::Finding& finding : result.findings) {
    std::string line = finding.engine.empty() ? "" : finding.engine + ", ";
    line += fmt::format("{}: {}", name_of(finding.kind), finding.how);
    blocks.emplace_back(Paragraph{line}, Audience::documents);
    Bullets assumptions;
    for (const std::string& one : finding.assumptions) {
      assumptions.items.emplace_back("assuming " + one);
    }
    if (!assumptions.items.empty()) blocks.emplace_back(assumptions, Audience::documents);
    std::string lines;
    for (const std::string& one : finding.details) lines += one + "\n";
    if (!lines.empty()) blocks.emplace_back(Listing{lines}, Audience::documents);
  }
  return blocks;
}

/// Why the rules do not promise it, and whether this deployment shows what its library does.
std::string weakness_of(const PropertyResult& result, model::ImplementationKind rules) {
  std::string text{applicability_of(*result.property, rules).weakness};
  const bool seen = result.property->is_of_library && result.verdict == VerdictKind::violated;
  return seen ? text + "; a run of this deployment shows it" : text;
}

Table::Row row_of(const PropertyResult& result, Standing standing, const CheckContext& context) {
  const std::string id{result.property->id};
  const bool told = result.verdict == VerdictKind::violated && result.counterexample() != nullptr;
  const bool possible = standing == Standing::possible;
  const model::ImplementationKind rules = model::kind_of(context.scenario.dds);
  Table::Row row;
  row.cells = {
      possible ? report::badge(report::Tone::info, "possible") : report::badge(result.verdict),
      told ? report::link(id, id) : report::code(id), statement_of(*result.property, rules),
      possible ? weakness_of(result, rules) : sentence_of(result)};
  if (possible) row.details.emplace_back(Paragraph{sentence_of(result)}, Audience::verbose);
  for (Block& block : findings_at_terminal(result, context)) {
    if (possible && block.audience == Audience::terminal) block.audience = Audience::explained;
    row.details.push_back(std::move(block));
  }
  for (Block& block : findings_in_documents(result)) row.details.push_back(std::move(block));
  const std::size_t count = result.decisive().assumptions.size();
  row.summary = (count == 0 ? "no assumptions" : report::plural(count, "assumption")) + ", " +
                report::plural(result.findings.size(), "finding");
  return row;
}

const char* title_of(Standing standing) {
  switch (standing) {
    case Standing::disputed:
      return "What is disputed: answers contradict each other, and none of them counts";
    case Standing::fails:
      return "What fails";
    case Standing::accepted:
      return "What fails and is accepted by the baseline";
    case Standing::open:
      return "What is not established";
    case Standing::possible:
      return "What the rules do not promise";
    case Standing::unknown:
      return "What nobody has looked at";
    case Standing::holds:
      return "What holds, and how";
  }
  return "";
}

/// The properties of one standing.
void add_verdicts(report::Document& document, const CheckReport& report,
                  const CheckContext& context, Standing standing) {
  const bool holds = standing == Standing::holds;
  Table table;
  table.columns = {{"verdict"}, {"property"}, {"what it says"}, {holds ? "how" : "why"}};
  table.columns[2].audience = Audience::page;
  table.columns[2].wraps = true;
  table.columns[3].wraps = true;
  for (const VerdictKind kind : props::verdict_kinds) {
    for (std::size_t k = 0; k < report.results.size(); ++k) {
      if (report.results[k].verdict != kind || context.gate.standings[k] != standing) continue;
      table.rows.push_back(row_of(report.results[k], standing, context));
    }
  }
  if (table.rows.empty()) return;
  Section section{title_of(standing), name_of(standing)};
  section.folded_in_comments = holds;
  if (standing == Standing::possible) {
    section.blocks.emplace_back(
        Paragraph{"Under other delays or losses than those of this deployment it can break, or it "
                  "is a margin that this deployment exceeds, or what the library does everywhere; "
                  "--strict counts that as a failure."});
  }
  section.blocks.emplace_back(std::move(table));
  // At a terminal what holds is a number in the table of questions, unless it was asked for.
  const bool few = report.results.size() <= 3;
  document.blocks.emplace_back(std::move(section),
                               holds && !few ? Audience::verbose : Audience::everybody);
}

/// Names of machines that pages draw below all violations.
using Machines = std::shared_ptr<std::set<std::string>>;

Section violation(const PropertyResult& result, const CheckContext& context, std::size_t number,
                  const Machines& machines) {
  const std::string id{result.property->id};
  Section section{"✗ " + id, id};
  const auto found = context.stories.find(id);
  const report::Story story = found == context.stories.end() ? report::Story{} : found->second;
  const std::string statement =
      statement_of(*result.property, model::kind_of(context.scenario.dds));
  const Audience unless_told = !story ? Audience::everybody : Audience::documents;
  section.blocks.emplace_back(Paragraph{statement}, unless_told);
  section.blocks.emplace_back(Paragraph{sentence_of(result), report::Tone::bad}, unless_told);
  if (const props::Counterexample* counterexample = result.counterexample()) {
    const auto walk = [run = *counterexample, id, number, story, machines]() -> Blocks {
      report::Sequence sequence =
          counterexample::walk(run, counterexample::chart_of(run), fmt::format("chart-{}", number),
                               "How " + id + " breaks", *machines);
      sequence.story = story;
      return {std::move(sequence)};
    };
    section.blocks.emplace_back(report::Later{walk}, Audience::documents);
  }
  if (story) {
    report::Sequence told;
    told.story = story;
    section.blocks.emplace_back(std::move(told), Audience::terminal);
  }
  std::string details;
  for (const std::string& line : result.decisive().details) details += line + "\n";
  section.blocks.emplace_back(Listing{details}, !story ? Audience::terminal : Audience::explained);
  const auto file = context.counterexamples.find(id);
  if (file != context.counterexamples.end()) {
    const std::string command = report::command_line({"replay", file->second});
    section.blocks.emplace_back(Paragraph{"replay it: " + report::code(command)},
                                Audience::terminal);
    section.blocks.emplace_back(Paragraph{"Replay it through the state machines:"},
                                Audience::documents);
    section.blocks.emplace_back(report::Command{command}, Audience::documents);
  }
  return section;
}

void add_violations(report::Document& document, const CheckReport& report,
                    const CheckContext& context) {
  Section section{"What breaks, step by step", "violations"};
  const auto machines = std::make_shared<std::set<std::string>>();
  std::size_t number = 0;
  bool any = false;  // that a terminal shows
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    const PropertyResult& result = report.results[k];
    if (result.verdict != VerdictKind::violated) continue;
    const bool possible = context.gate.standings[k] == Standing::possible;
    section.blocks.emplace_back(violation(result, context, number++, machines),
                                possible ? Audience::verbose : Audience::everybody);
    any = any || !possible;
  }
  if (section.blocks.empty()) return;
  const auto diagrams = [machines]() -> Blocks {
    if (machines->empty()) return {};
    return {counterexample::diagrams_of(*machines)};
  };
  section.blocks.emplace_back(report::Later{diagrams}, Audience::page);
  if (!any) section.title = "How it could break";
  document.blocks.emplace_back(std::move(section));
}

void add_run(report::Document& document, const CheckContext& context) {
  const auto plots = [scenario = context.scenario]() -> Blocks {
    const report::RunPlots run = report::run_plots(scenario);
    Blocks blocks{Paragraph{run.note}};
    for (const std::string& svg : run.drawings) blocks.emplace_back(report::Drawing{svg, ""});
    return blocks;
  };
  document.blocks.emplace_back(Section{"The run of the scenario", "run", {report::Later{plots}}},
                               Audience::page);
}

void add_knobs(Table& table, const nlohmann::ordered_json& value, const std::string& key,
               const CheckContext& context, const std::string& file) {
  if (key == "dds.unmodelled") return;
  if (value.is_object() && !value.empty()) {
    for (const auto& [name, part] : value.items()) {
      add_knobs(table, part, key.empty() ? name : key + "." + name, context, file);
    }
    return;
  }
  const auto place = context.places.find(key);
  const bool known = place != context.places.end();
  table.rows.push_back(
      {{report::code(key), value.is_string() ? value.get<std::string>() : value.dump(),
        known ? origin_text(place->second) : "default"},
       known && by_user(place->second, file)});
}

void add_profiles(report::Document& document, const CheckContext& context) {
  const std::string file = scenario_file(context.places, context.name);
  Table table;
  table.caption = "Every value that the runs used. Shaded: set by the scenario's own files.";
  table.columns = {{"key"}, {"value"}, {"where it comes from"}};
  for (report::Column& column : table.columns) column.wraps = true;
  add_knobs(table, model::config::effective_json(context.scenario.dds), "dds", context, file);
  add_knobs(table, model::config::effective_json(context.scenario.wireless), "wireless", context,
            file);
  Section section{"DDS and wireless profile, with the origin of each value", "profile"};
  section.folded = true;
  section.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(std::move(section), Audience::page);
}

}  // namespace

report::Document document_of(const CheckReport& report, const CheckContext& context) {
  report::Document document;
  document.title = "stormproof check " + context.name;
  document.complete = !report.interrupted;
  document.seconds = report.seconds;
  add_answer(document, report, context);
  if (const std::string text = report::unreached(context.scenario); !text.empty()) {
    document.blocks.emplace_back(Paragraph{text, report::Tone::warn});
  }
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    document.findings.push_back(ci_finding(report.results[k], context.gate.standings[k], context));
  }
  if (context.gate.outlook != Standing::holds) {
    document.findings.push_back(outlook_finding(report, context));
  }
  if (report.outlook && report.outlook->health() == exact::Health::storm) {
    document.blocks.emplace_back(Paragraph{exact::storm_definition(context.scenario.limits)});
  }
  for (const Standing standing : standings) add_verdicts(document, report, context, standing);
  if (report.frontiers) add_frontiers(document, *report.frontiers);
  add_unmodelled(document, context.scenario, &context.places);
  add_violations(document, report, context);
  add_run(document, context);
  add_profiles(document, context);
  // Of a failure in a fine run the replay is the next thing to look at.
  const bool told = context.gate.exit_code != 0 && report.outlook &&
                    report.outlook->health() == exact::Health::fine;
  if (report.outlook && !told) {
    document.next = next_steps(context.words, context.scenario, *report.outlook);
  }
  return document;
}

}  // namespace stormproof::checker
