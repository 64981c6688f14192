// A fuzz report for a person: what was varied, the verdicts, the distribution of the runs, then
// each counterexample, then how to repeat it.
#include <algorithm>

#include <fmt/format.h>

#include "checker/experiments/fuzz/fuzz_report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "model/config/tree/quantities.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::fuzz {

namespace {

using model::config::print_duration;
using report::grouped;
using report::left;
using report::paragraph;
using report::right;

constexpr std::size_t verdict_columns = 14;
constexpr std::size_t id_columns = 30;

std::string rate_text(double rate) { return fmt::format("{:.2f} %", 100 * rate); }

std::string plural(std::uint64_t count, const char* noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

/// "limit.completion 3s".
std::string name_text(const Judgment& judgment, const model::Scenario& scenario) {
  std::string text{judgment.id};
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

std::string heading(const FuzzReport& report, const FuzzContext& context) {
  const model::Scenario& scenario = context.scenario;
  const bool fastdds = scenario.dds.implementation == model::ImplementationKind::fastdds;
  std::string text =
      fmt::format("{}: {}, {}\n", context.name, plural(scenario.deployment.size(), "participant"),
                  fastdds ? "Fast DDS's own rules" : "the rules of the closed-loop model");
  text += fmt::format("{}, seed {}", plural(report.runs.size(), "run"), report.seed);
  if (!report.runs.empty()) {
    text += fmt::format(", numbers {} to {}", report.first, report.runs.back().number);
  }
  text += "; each is drawn from\n";
  const std::vector<RangeText> ranges = describe(report.ranges, scenario);
  std::size_t name_columns = 14;
  for (const RangeText& range : ranges) name_columns = std::max(name_columns, range.name.size());
  for (const RangeText& range : ranges) {
    text += paragraph("  " + left(range.name, name_columns + 2), range.text);
  }
  if (ranges.empty()) text += "  nothing: no range is left, so all runs are the same\n";
  if (report.ranges.usual) {
    text += "These are the usual ranges: neither the scenario (vary:) nor an option states any.\n";
  }
  if (!scenario.limits || !scenario.limits->any()) {
    text += paragraph("",
                      "The scenario has no limits, so only properties are judged; limits: in "
                      "the scenario or --limit NAME=VALUE adds some.");
  }
  if (report.rejected > 0) {
    text += fmt::format("{} gave no valid scenario and {} repeated.\n",
                        plural(report.rejected, "draw"), report.rejected == 1 ? "was" : "were");
  }
  return text;
}

std::string judgment_text(const Judgment& judgment, const FuzzContext& context) {
  std::string verdict = props::name_of(judgment.verdict);
  if (judgment.verdict == props::VerdictKind::violated) verdict = "VIOLATED";
  std::string text;
  if (!judgment.sampled) {
    text = "without any variation, so no variant was judged by it; see stormproof check";
  } else if (judgment.runs == 0) {
    text = "no run says anything about it";
  } else {
    text = fmt::format("{} of {}: ", grouped(judgment.broken), plural(judgment.runs, "run"));
    if (judgment.broken == 0) {
      text += fmt::format("at most {}", rate_text(judgment.rate.high));
    } else {
      text += fmt::format(
          "{}, between {} and {}",
          rate_text(static_cast<double>(judgment.broken) / static_cast<double>(judgment.runs)),
          rate_text(judgment.rate.low), rate_text(judgment.rate.high));
    }
    if (judgment.in_base) text += ", and without any variation";
  }
  return paragraph(left(judgment.sampled ? verdict : "violated", verdict_columns) +
                       left(name_text(judgment, context.scenario), id_columns),
                   text);
}

std::string quantile_row(const char* name, const sampling::Quantiles& quantiles, auto&& print) {
  std::string row = left(name, 20);
  for (const auto& value :
       {quantiles.min, quantiles.p10, quantiles.median, quantiles.p90, quantiles.max}) {
    row += right(value ? print(*value) : "–", 13);
  }
  return row;
}

std::string distribution(const FuzzReport& report) {
  const auto time = [](double ns) {
    return report::duration(model::Nanoseconds{static_cast<std::int64_t>(ns)});
  };
  const auto count = [](double value) { return grouped(static_cast<std::uint64_t>(value)); };
  const auto ratio = [](double value) { return fmt::format("{:.3g}×", value); };
  const JudgedRun& base = report.base;
  const auto row = [](const std::string& values, const std::string& unperturbed) {
    return values + right(unperturbed, 15) + "\n";
  };
  std::string text =
      "\n" + row(fmt::format("{}{}{}{}{}{}", left("", 20), right("least", 13), right("10 %", 13),
                             right("median", 13), right("90 %", 13), right("most", 13)),
                 "unperturbed");
  text += row(quantile_row("completion", report.completion_ns, time),
              base.discovery_time ? report::duration(*base.discovery_time) : "–");
  text += row(quantile_row("messages", report.messages, count), grouped(base.messages));
  text +=
      row(quantile_row("amplification", report.amplification, ratio), ratio(base.amplification));
  text += row(quantile_row("highest backlog", report.backlog, count), grouped(base.backlog));
  if (report.incomplete > 0) {
    text += fmt::format("Discovery was not complete at the time limit in {} of {}.\n",
                        grouped(report.incomplete), plural(report.runs.size(), "run"));
  }
  return text;
}

std::string counterexample_text(const FuzzReport& report, const Judgment& judgment,
                                const FuzzContext& context) {
  std::string text = fmt::format("\n{}\n", std::string(report::report_width, '-'));
  text += fmt::format("VIOLATED {}, first by run {}\n", judgment.id, judgment.first_broken);
  text += paragraph("  statement  ", judgment.statement);
  text += paragraph("  that run   ", judgment.first_reason);
  if (judgment.shrunk) {
    const Shrunk& shrunk = *judgment.shrunk;
    text +=
        paragraph("  smallest   ",
                  fmt::format("{} ({} of {} simpler scenarios broke it, too{})",
                              shrunk.counterexample.reason, shrunk.accepted, shrunk.tried,
                              shrunk.finished ? "" : "; the search ended there, its effort spent"));
    const char* first = "  differs    ";
    for (const std::string& line : differences(shrunk.counterexample.scenario, context.scenario)) {
      text += paragraph(first, line);
      first = "             ";
    }
  }
  const auto stem = context.stems.find(judgment.id);
  if (stem != context.stems.end()) {
    text += fmt::format("  files      {}.yaml (scenario), .txt (story), .svg and .mmd (chart)\n",
                        stem->second);
    text += fmt::format("  replay     stormproof replay {}.jsonl\n", stem->second);
  }
  return text + fmt::format("  run it     {}\n", context.single(report, judgment.first_broken));
}

}  // namespace

std::string FuzzContext::whole(const FuzzReport& report) const {
  std::string text =
      fmt::format("{} --runs {} --seed {}", command, report.runs.size(), report.seed);
  if (report.first > 0) text += fmt::format(" --first {}", report.first);
  return text;
}

std::string FuzzContext::single(const FuzzReport& report, std::uint64_t number) const {
  return fmt::format("{} --runs 1 --seed {} --first {}", command, report.seed, number);
}

std::string to_text(const FuzzReport& report, const FuzzContext& context) {
  std::string text = heading(report, context) + "\n";
  text +=
      left("verdict", verdict_columns) + left("property or limit", id_columns) + "violated in\n";
  for (const Judgment& judgment : report.judgments) text += judgment_text(judgment, context);
  if (!report.runs.empty()) text += distribution(report);
  for (const Judgment& judgment : report.judgments) {
    if (judgment.broken > 0) text += counterexample_text(report, judgment, context);
  }
  text += "\n";
  if (report.undrawable) {
    text += paragraph("",
                      "1,000 draws in a row gave no valid scenario: the ranges and the rules "
                      "between knobs (specs/guide/model.md) hardly meet.");
  }
  if (report.interrupted) {
    text += fmt::format("Interrupted after {} of {}.\n", grouped(report.runs.size()),
                        plural(report.wanted, "run"));
  }
  if (report.runs.empty()) return text + "No run finished, so nothing is known.\n";
  text += paragraph("", fmt::format("Rates are those of all scenarios in the ranges, with {:.0f} % "
                                    "confidence (exact interval of Clopper and Pearson). A sample "
                                    "proves nothing about the runs that it does not contain.",
                                    100 * confidence_level));
  if (!context.scenario.dds.unmodelled.empty()) {
    text += report::unmodelled_text(context.scenario.dds) + "\n";
  }
  return text + "repeat it with: " + context.whole(report) + "\n";
}

}  // namespace stormproof::fuzz
