// A fuzz report as a document: what was varied, the verdicts, the distribution of the runs, then
// each counterexample.
#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/experiments/trials/tone_of_health.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/implementations.hpp"

namespace stormproof::fuzz {

namespace {

using model::config::print_duration;
using report::Blocks;
using report::Column;
using report::Document;
using report::Facts;
using report::grouped;
using report::Paragraph;
using report::plural;
using report::Section;
using report::Table;
using report::Text;
using report::Tone;

std::string rate_text(double rate) { return fmt::format("{:.2f} %", 100 * rate); }

/// "limit.completion 3s".
std::string name_text(const Judgment& judgment, const model::Scenario& scenario) {
  std::string text{judgment.id};
  if (text == "limit.time") return text + " " + print_duration(scenario.time_limit);
  if (!scenario.limits) return text;
  const model::Limits& limits = *scenario.limits;
  if (text == "limit.completion") return text + " " + print_duration(*limits.completion);
  if (text == "limit.messages") return text + " " + grouped(*limits.messages);
  if (text == "limit.amplification") {
    return text + fmt::format(" {:.4g}×", limits.amplification->value());
  }
  if (text == "limit.backlog") return text + " " + plural(*limits.backlog, "packet");
  return text;
}

Tone tone_of(props::VerdictKind verdict) {
  if (verdict == props::VerdictKind::violated) return Tone::bad;
  return verdict == props::VerdictKind::inconclusive ? Tone::warn : Tone::good;
}

/// "40 runs, seed 3, numbers 0 to 39; each is drawn from".
std::string runs_text(const FuzzReport& report) {
  std::string text = fmt::format("{}, seed {}", plural(report.runs.size(), "run"), report.seed);
  if (!report.runs.empty()) {
    text += fmt::format(", numbers {} to {}", report.first, report.runs.back().number);
  }
  return text + "; each is drawn from";
}

void add_ranges(Blocks& blocks, const FuzzReport& report, const model::Scenario& scenario) {
  blocks.emplace_back(Paragraph{runs_text(report)});
  Facts facts;
  for (RangeText& range : describe(report.ranges, scenario)) {
    facts.rows.emplace_back(std::move(range.name), std::move(range.text));
  }
  if (facts.rows.empty()) {
    blocks.emplace_back(Paragraph{"nothing: no range is left, so all runs are the same"});
  } else {
    blocks.emplace_back(std::move(facts));
  }
  std::string remarks;
  if (report.ranges.usual) {
    remarks +=
        "These are the usual ranges: neither the scenario (vary:) nor an option states any. ";
  }
  if (!scenario.limits || !scenario.limits->any()) {
    remarks +=
        "The scenario has no limits, so only properties are judged; limits: in the scenario or "
        "--limit NAME=VALUE adds some. ";
  }
  if (report.rejected > 0) {
    remarks += fmt::format("{} gave no valid scenario and {} repeated. ",
                           plural(report.rejected, "draw"), report.rejected == 1 ? "was" : "were");
  }
  if (remarks.empty()) return;
  remarks.pop_back();
  blocks.emplace_back(Paragraph{std::move(remarks)});
}

std::string result_text(const Judgment& judgment) {
  if (!judgment.sampled) {
    return "without any variation, so no variant was judged by it; see stormproof check";
  }
  if (judgment.runs == 0) return "no run says anything about it";
  std::string text =
      fmt::format("{} of {}: ", grouped(judgment.broken), plural(judgment.runs, "run"));
  if (judgment.broken == 0) {
    text += "at most " + rate_text(judgment.rate.high);
  } else {
    text += fmt::format(
        "{}, between {} and {}",
        rate_text(static_cast<double>(judgment.broken) / static_cast<double>(judgment.runs)),
        rate_text(judgment.rate.low), rate_text(judgment.rate.high));
  }
  if (judgment.in_base) text += ", and without any variation";
  return text;
}

Table verdicts(const FuzzReport& report, const FuzzContext& context) {
  Table table{{{"verdict"}, {"property or limit"}, {"violated in", Column::Align::left, true}}, {}};
  for (const Judgment& judgment : report.judgments) {
    const auto verdict = judgment.sampled ? judgment.verdict : props::VerdictKind::violated;
    // What breaks without any variation was known before: no verdict of this sample.
    const Tone tone = judgment.sampled ? tone_of(verdict) : Tone::info;
    table.rows.push_back({{report::badge(tone, props::name_of(verdict)),
                           name_text(judgment, context.scenario), result_text(judgment)},
                          judgment.broken > 0});
  }
  return table;
}

Table distribution(const FuzzReport& report) {
  const auto time = [](double ns) {
    return report::duration(model::Nanoseconds{static_cast<std::int64_t>(ns)});
  };
  const auto count = [](double value) { return grouped(static_cast<std::uint64_t>(value)); };
  const auto ratio = [](double value) { return fmt::format("{:.3g}×", value); };
  Table table{{{""}}, {}};
  for (const char* head : {"least", "10 %", "median", "90 %", "most", "unperturbed"}) {
    table.columns.push_back({head, Column::Align::right});
  }
  const auto row = [&table](const char* name, const statistics::Quantiles& q, auto&& print,
                            std::string unperturbed) {
    std::vector<Text> cells{name};
    for (const auto& value : {q.min, q.p10, q.median, q.p90, q.max}) {
      cells.emplace_back(value ? print(*value) : "–");
    }
    cells.emplace_back(std::move(unperturbed));
    table.rows.push_back({std::move(cells)});
  };
  const JudgedRun& base = report.base;
  row("completion", report.completion_ns, time,
      base.discovery_time ? report::duration(*base.discovery_time) : "–");
  row("messages", report.messages, count, grouped(base.messages));
  row("amplification", report.amplification, ratio, ratio(base.amplification));
  row("highest backlog", report.backlog, count, grouped(base.backlog));
  return table;
}

Section counterexample(const FuzzReport& report, const Judgment& judgment,
                       const FuzzContext& context) {
  Facts facts;
  facts.rows.emplace_back("statement", judgment.statement);
  facts.rows.emplace_back("that run", judgment.first_reason);
  if (judgment.shrunk) {
    const Shrunk& shrunk = *judgment.shrunk;
    facts.rows.emplace_back(
        "smallest",
        fmt::format("{} ({} of {} simpler scenarios broke it, too{})", shrunk.counterexample.reason,
                    shrunk.accepted, shrunk.tried,
                    shrunk.finished ? "" : "; the search ended there, its effort spent"));
    const char* label = "differs";
    for (std::string& line : differences(shrunk.counterexample.scenario, context.scenario)) {
      facts.rows.emplace_back(std::exchange(label, ""), std::move(line));
    }
  }
  const auto stem = context.stems.find(judgment.id);
  if (stem != context.stems.end()) {
    facts.rows.emplace_back("files", report::code(stem->second + ".yaml") +
                                         " (scenario), .txt (story), .svg and .mmd "
                                         "(chart)");
  }
  if (const auto trace = context.traces.find(judgment.id); trace != context.traces.end()) {
    facts.rows.emplace_back("replay",
                            report::code(report::command_line({"replay", trace->second})));
  }
  facts.rows.emplace_back("run it", report::code(context.single(report, judgment.first_broken)));
  return {fmt::format("VIOLATED {}, first by run {}", judgment.id, judgment.first_broken),
          std::string{judgment.id},
          {std::move(facts)}};
}

report::Finding finding_of(const Judgment& judgment, const FuzzContext& context) {
  using Outcome = report::Finding::Outcome;
  report::Finding finding;
  finding.id = judgment.id;
  finding.statement = judgment.statement;
  finding.outcome = !judgment.sampled                                      ? Outcome::note
                    : judgment.verdict == props::VerdictKind::violated     ? Outcome::failed
                    : judgment.verdict == props::VerdictKind::inconclusive ? Outcome::unknown
                                                                           : Outcome::passed;
  finding.word = props::name_of(judgment.verdict);
  finding.message = name_text(judgment, context.scenario) + ": " + result_text(judgment);
  finding.details = judgment.first_reason;
  finding.shown = report::Finding::Shown::tests;
  return finding;
}

/// Whether some runs were not watched for what the rules promise.
bool has_unwatched(const FuzzReport& report) {
  return report.runs.size() > watched_first &&
         std::ranges::any_of(report.judgments, &Judgment::promised);
}

std::string breaches_text(const FuzzReport& report, const model::Scenario& scenario) {
  const auto broken = std::ranges::count_if(
      report.judgments, [](const Judgment& judgment) { return judgment.broken > 0; });
  if (broken == 0) {
    return fmt::format("None of {} breaks a property or limit{}.",
                       plural(report.runs.size(), "run"),
                       has_unwatched(report) ? " that it was watched for" : "");
  }
  const auto worst = std::ranges::max_element(report.judgments, {}, [](const Judgment& judgment) {
    return static_cast<double>(judgment.broken) /
           static_cast<double>(std::max<std::size_t>(judgment.runs, 1));
  });
  std::string text = fmt::format("{} breaks in {} of {}", name_text(*worst, scenario),
                                 grouped(worst->broken), plural(worst->runs, "run"));
  if (broken > 1)
    text += fmt::format("; {} of {} properties and limits break", broken, report.judgments.size());
  return text + ".";
}

/// What the runs were like stands before what they break if it is more than a slow start.
std::string answer_text(const FuzzReport& report, const std::optional<exact::Outlook>& outlook,
                        const model::Scenario& scenario) {
  if (!outlook) return "No run finished, so nothing is known.";
  const std::string breaches = breaches_text(report, scenario);
  if (outlook->health() != exact::Health::storm) return breaches;
  return fmt::format("{}: {}. {}", outlook->headline(), outlook->sentence(), breaches);
}

/// A storm breaks no property, and looks as bad as it does in `simulate`.
Tone tone_of(const FuzzReport& report, const std::optional<exact::Outlook>& outlook) {
  if (report.violated()) return Tone::bad;
  if (outlook && outlook->health() == exact::Health::storm)
    return report::tone_of(exact::Health::storm);
  return report.interrupted || !outlook ? Tone::warn : Tone::good;
}

void add_reservations(Document& document, const FuzzReport& report) {
  Blocks& blocks = document.blocks;
  if (report.undrawable) {
    blocks.emplace_back(
        Paragraph{"1,000 draws in a row gave no valid scenario: the ranges and the rules between "
                  "knobs (specs/guide/model.md) hardly meet."});
  }
  if (report.interrupted) {
    blocks.emplace_back(Paragraph{fmt::format(
        "Interrupted after {} of {}.", grouped(report.runs.size()), plural(report.wanted, "run"))});
  }
  if (report.runs.empty()) return;
  if (has_unwatched(report)) {
    blocks.emplace_back(Paragraph{
        fmt::format("What the rules promise was watched in the first {} runs and in every {}th; "
                    "--property ID watches it in all of them.",
                    watched_first, watched_each)});
  }
  blocks.emplace_back(Paragraph{fmt::format(
      "Rates are those of all scenarios in the ranges, with {:.0f} % confidence (exact "
      "interval of Clopper and Pearson). A sample proves nothing about the runs that it "
      "does not contain.",
      100 * statistics::confidence_level)});
}

}  // namespace

std::string FuzzContext::whole(const FuzzReport& report) const {
  // The ranges may have had no run to draw, which is then the answer to as many as were wanted.
  const std::size_t runs = report.runs.empty() ? report.wanted : report.runs.size();
  std::string text = fmt::format("{} --runs {} --seed {}", command, runs, report.seed);
  if (report.first > 0) text += fmt::format(" --first {}", report.first);
  return text;
}

std::string FuzzContext::single(const FuzzReport& report, std::uint64_t number) const {
  return fmt::format("{} --runs 1 --seed {} --first {}", command, report.seed, number);
}

Document document_of(const FuzzReport& report, const FuzzContext& context) {
  const model::Scenario& scenario = context.scenario;
  const bool open = report.interrupted || report.runs.empty();
  Document document;
  document.title = "stormproof fuzz " + context.name;
  document.exit_code = report.violated() ? 1 : open ? 3 : 0;
  const auto outlook = trials::outlook_of(report.runs);
  document.tone = tone_of(report, outlook);
  document.complete = !report.interrupted;
  document.command = context.whole(report);
  document.subject =
      fmt::format("{}: {}, {}", context.name, plural(scenario.deployment.size(), "participant"),
                  model::traits_of(scenario.dds).rules);
  document.answer = answer_text(report, outlook, scenario);
  add_ranges(document.blocks, report, scenario);
  document.blocks.emplace_back(verdicts(report, context));
  if (!report.runs.empty()) document.blocks.emplace_back(distribution(report));
  report::add_definition(document.blocks, outlook && outlook->health() == exact::Health::storm,
                         scenario.limits);
  if (report.incomplete > 0) {
    document.blocks.emplace_back(
        Paragraph{fmt::format("Discovery was not complete at the time limit in {} of {}.",
                              grouped(report.incomplete), plural(report.runs.size(), "run"))});
  }
  for (const Judgment& judgment : report.judgments) {
    document.findings.push_back(finding_of(judgment, context));
    if (judgment.broken > 0) {
      document.blocks.emplace_back(counterexample(report, judgment, context));
    }
  }
  add_reservations(document, report);
  report::add_unmodelled(document, scenario);
  return document;
}

}  // namespace stormproof::fuzz
