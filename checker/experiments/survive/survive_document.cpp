// What is not survived and what cures it first, then every failure with how soon it is over.
#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/core.h>

#include "checker/experiments/survive/survive_report.hpp"
#include "checker/presentation/charts/plot.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/implementations.hpp"

namespace stormproof::survive {

namespace {

using report::Column;
using report::Paragraph;
using report::Table;
using report::Tone;

constexpr const char* beyond = "> limit";

/// "2.310 s [0.81 s – 3.02 s]", or in how many runs it is not survived.
std::string recovery_text(const Outcome& outcome) {
  const statistics::Quantiles& q = outcome.recovery;
  if (!outcome.is_survived()) {
    return fmt::format("✗ not in {} of {}", outcome.runs - outcome.recovered, outcome.runs);
  }
  const std::string median = report::time_figure(q.median, beyond);
  if (q.count < 2 || q.max == q.min) return median;
  return fmt::format("{} [{} – {}]", median, report::time_figure(q.min, beyond),
                     report::time_figure(q.max, beyond));
}

/// The failure that is survived, and takes longest.
const Outcome* slowest(const Report& report) {
  const Outcome* most = nullptr;
  for (const Outcome& outcome : report.versions.front().outcomes) {
    if (!outcome.recovery.max) continue;
    if (most == nullptr || *outcome.recovery.max > *most->recovery.max) most = &outcome;
  }
  return most;
}

/// "the network for 60.00 s, the network for 120.0 s and 3 more".
std::string unsurvived_text(const Version& version) {
  constexpr std::size_t named = 2;
  std::string text;
  std::size_t count = 0;
  for (const Outcome& outcome : version.outcomes) {
    if (outcome.is_survived() || ++count > named) continue;
    text += (text.empty() ? "" : ", ") + words_of(outcome.failure);
  }
  return count > named ? fmt::format("{} and {} more", text, count - named) : text;
}

std::string answer_of(const Report& report, const Request& request) {
  const Version& own = report.versions.front();
  if (own.outcomes.empty()) {
    return own.undiscovered == 0
               ? "Nothing was tried."
               : fmt::format("Discovery is not complete within {} before anything fails.",
                             report::duration(request.limit));
  }
  const auto open = static_cast<std::size_t>(std::ranges::count_if(
      own.outcomes, [](const Outcome& outcome) { return !outcome.is_survived(); }));
  if (open > 0) {
    return fmt::format("{} of {} {} not survived: {}.", open,
                       report::plural(own.outcomes.size(), "failure"), open == 1 ? "is" : "are",
                       unsurvived_text(own));
  }
  const Outcome* worst = slowest(report);
  return fmt::format(
      "{} {} survived: everybody has everything again within {} of the end of each "
      "({}).",
      report::plural(own.outcomes.size(), "failure"), own.outcomes.size() == 1 ? "is" : "are",
      report::time_figure(worst->recovery.max, beyond), words_of(worst->failure));
}

Table table_of(const Report& report, const Request& request) {
  Table table{{{"away"}, {"for", Column::Align::right}}, {}};
  for (const Version& version : report.versions) {
    table.columns.push_back({version.name + ": recovery [range]", Column::Align::right});
  }
  table.columns.push_back({"lost pairs", Column::Align::right});
  table.columns.push_back({"messages", Column::Align::right});
  table.wide = true;
  table.caption = fmt::format(
      "from the end of the failure until everybody has everything again and nobody holds who is "
      "gone; limit {} after a lease; lost pairs and messages {}: medians",
      report::duration(request.limit), report.versions.front().name);
  for (const Outcome& outcome : report.versions.front().outcomes) {
    const Failure& failure = outcome.failure;
    Table::Row row{{words_of(failure.kind),
                    failure.length.count() == 0 ? "ever" : report::duration(failure.length)},
                   !outcome.is_survived()};
    for (const Version& version : report.versions) {
      const auto same = std::ranges::find(version.outcomes, failure, &Outcome::failure);
      row.cells.emplace_back(same == version.outcomes.end() ? "–" : recovery_text(*same));
    }
    row.cells.emplace_back(report::count_figure(outcome.lost_pairs.median));
    row.cells.emplace_back(report::count_figure(outcome.messages.median));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// "the network for 60.00 s: 0 of 5 runs recover; with SPDPInterval 5 s 5 of 5, within 2.850 s".
std::string cure_text(const Version& version, const Outcome& outcome) {
  std::string text = fmt::format("{}: {} of {} runs recover", words_of(outcome.failure),
                                 outcome.recovered, outcome.runs);
  for (const Attempt& attempt : version.attempts) {
    if (attempt.failure != outcome.failure) continue;
    text += fmt::format("; with {}: {} of {}", attempt.cure.name, attempt.recovered, attempt.runs);
    if (attempt.cures()) {
      text += fmt::format(", within {}", report::time_figure(attempt.recovery.max, beyond));
    }
  }
  if (const auto from = version.survived_from(outcome.failure.kind)) {
    text += fmt::format("; lengths from {} on are survived", report::duration(*from));
  }
  return text;
}

/// Cures that help in all that is not survived, or in some of it, with whose they are.
void add_cures(report::Blocks& blocks, const Version& version) {
  report::Bullets open;
  for (const Outcome& outcome : version.outcomes) {
    if (!outcome.is_survived()) open.items.emplace_back(cure_text(version, outcome));
  }
  if (open.items.empty()) return;
  blocks.emplace_back(Paragraph{"Not survived, and what was tried against it:"});
  blocks.emplace_back(std::move(open));
  report::Facts cures;
  for (const Attempt& attempt : version.attempts) {
    const auto is_same = [&](const auto& row) { return row.first == attempt.cure.name; };
    if (!attempt.cures() || std::ranges::any_of(cures.rows, is_same)) continue;
    cures.rows.emplace_back(attempt.cure.name, attempt.cure.source);
  }
  if (!cures.rows.empty()) blocks.emplace_back(std::move(cures));
}

void add_assumptions(report::Document& document, const Report& report, const Request& request) {
  document.assumptions.emplace_back(fmt::format(
      "Each failure begins when everybody has known everybody for 1 s, and up to one announcement "
      "period ({}) later; one at the start begins half way to completion.",
      report::duration(report.versions.front().scenario.dds.spdp.period)));
  document.assumptions.emplace_back(
      "Nothing but the failure is lost, and it happens to the last host, and to its first "
      "process.");
  document.assumptions.emplace_back(
      fmt::format("Not survived means: not within {} after the failure and a lease.",
                  report::duration(request.limit)));
  if (model::traits_of(report.versions.front().scenario.dds).vendor == model::vendor::fastdds) {
    document.assumptions.emplace_back(
        "Programs take no time, so where everybody is learned again at once and that storms, it "
        "takes up to twice as long here as in live runs (specs/guide/coverage.md).");
  }
  if (report.without_processors) {
    document.assumptions.emplace_back(
        "Programs take no time and no sender waits for a full queue: rules of failures know "
        "neither "
        "hosts nor sender: stalls.");
  }
  report::add_unmodelled(document, report.versions.front().scenario.dds);
}

}  // namespace

report::Document document_of(const Report& report, const Request& request) {
  const Version& own = report.versions.front();
  report::Document document;
  document.title = "stormproof survive " + request.scenario;
  document.answer = answer_of(report, request);
  document.subject = fmt::format("{}: {}, up to {} of each", request.scenario,
                                 report::plural(own.outcomes.size(), "failure"),
                                 report::plural(request.samples, "run"));
  document.complete = !report.interrupted;
  const bool is_open = report.interrupted || own.outcomes.empty();
  const bool is_bad = report.unsurvived() > 0;
  document.exit_code = is_bad ? 1 : is_open ? 3 : 0;
  document.tone = is_bad ? Tone::bad : is_open ? Tone::warn : Tone::good;
  if (own.undiscovered > 0 && !own.outcomes.empty()) {
    document.elaboration =
        fmt::format("Without a failure, discovery is not complete within {} in {}.",
                    report::duration(request.limit), report::plural(own.undiscovered, "run"));
  }
  add_cures(document.blocks, own);
  document.blocks.emplace_back(table_of(report, request));
  document.blocks.emplace_back(report::Drawing{to_svg(report), ""}, report::Audience::page);
  report::Facts facts;
  add_unasked(facts, report.unasked);
  if (!facts.rows.empty()) document.blocks.emplace_back(std::move(facts));
  add_assumptions(document, report, request);
  return document;
}

std::string to_svg(const Report& report) {
  constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
  const auto seconds = [](const std::optional<double>& ns) { return ns ? *ns * 1e-9 : no_value; };
  plot::Chart chart;
  chart.title = "Recovery over how long somebody is away";
  chart.description =
      "From the end of the failure until everybody has everything again: median and range of the "
      "runs; crosses above: what is not survived.";
  chart.x = {"away", plot::Scale::log, {}, {}, "s", {}};
  chart.y = {"recovery", plot::Scale::linear, 0.0, {}, "s", {}};
  double top = 1;  // s, above all that recovers
  for (const Version& version : report.versions) {
    for (const Outcome& outcome : version.outcomes) {
      if (outcome.recovery.max) top = std::max(top, 1.1e-9 * *outcome.recovery.max);
    }
  }
  plot::Series never{"does not recover"};
  never.mark = plot::Mark::crosses;
  for (const Version& version : report.versions) {
    for (const Kind kind : {Kind::network, Kind::host, Kind::server_killed}) {
      plot::Series series;
      series.name = report.versions.size() > 1 ? fmt::format("{}, {}", words_of(kind), version.name)
                                               : std::string{words_of(kind)};
      for (const Outcome& outcome : version.outcomes) {
        if (outcome.failure.kind != kind) continue;
        series.x.push_back(static_cast<double>(outcome.failure.length.count()) * 1e-9);
        series.y.push_back(seconds(outcome.recovery.median));
        series.low.push_back(seconds(outcome.recovery.min));
        series.high.push_back(seconds(outcome.recovery.max));
        if (outcome.is_survived()) continue;
        never.x.push_back(series.x.back());
        never.y.push_back(top);
      }
      if (series.x.size() > 1) chart.series.push_back(std::move(series));
    }
  }
  if (!never.x.empty()) chart.series.push_back(std::move(never));
  return plot::to_svg(chart);
}

}  // namespace stormproof::survive
