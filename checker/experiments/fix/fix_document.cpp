// Before and after in the words of `simulate`, what was tried, and what to deploy.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/experiments/fix/fix_report.hpp"
#include "checker/experiments/statistics/confidence.hpp"
#include "checker/experiments/trials/tone_of_health.hpp"
#include "checker/experiments/trials/unasked.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/check/next_steps.hpp"

namespace stormproof::fix {

namespace {

using launch::Cell;
using report::Column;
using report::Document;
using report::Paragraph;
using report::Table;
using report::Tone;

std::string headline_of(const Cell& cell) {
  const auto outlook = trials::outlook_of(cell.runs);
  return outlook ? outlook->headline() : std::string{"–"};
}

std::string time_text(const std::optional<double>& ns) {
  return report::time_figure(ns, "> limit");
}

std::string completion_text(const Cell& cell) {
  return fmt::format("{} at the median, {} at worst", time_text(cell.completion.median),
                     time_text(cell.completion.max));
}

/// "a storm in 0 of 12 runs: with a probability of at most 26.5 %".
std::string storm_text(const Cell& cell) {
  const auto rate = statistics::clopper_pearson(cell.storms, cell.runs.size());
  return fmt::format("a storm in {} of {} runs, so with a probability of {} to {}", cell.storms,
                     cell.runs.size(), report::percent(rate.low, 1), report::percent(rate.high, 1));
}

std::string change_text(const Attempt& made) {
  std::string text = made.candidate.change;
  if (made.plan) text += (text.empty() ? "" : "; ") + launch::words_of(*made.plan);
  return text;
}

class Builder {
 public:
  Builder(const Report& report, const Request& request, const Context& context)
      : report_{report}, request_{request}, context_{context} {}

  Document build() {
    head();
    verdict();
    tried();
    what_to_deploy();
    const bool storms = report_.before.storms > 0;
    report::add_definition(document_.blocks, storms, report_.candidates.scenario.limits);
    assumptions();
    return std::move(document_);
  }

 private:
  [[nodiscard]] const Attempt* chosen() const {
    return report_.chosen ? &report_.attempts[*report_.chosen] : nullptr;
  }
  [[nodiscard]] std::string known() const {
    const auto runs = std::ranges::count_if(
        report_.attempts, [](const Attempt& made) { return made.not_run.empty(); });
    return report::plural(static_cast<std::size_t>(runs), "attempt");
  }

  void head() {
    document_.title = "stormproof fix " + request_.scenario;
    document_.subject = fmt::format("{}: {} to change it", request_.scenario, known());
    if (!request_.keep.empty()) {
      std::vector<std::string> kept;
      for (const Kind kind : request_.keep) kept.emplace_back(name_of(kind));
      document_.subject += fmt::format("; kept: {}", fmt::join(kept, ", "));
    }
    document_.complete = !report_.interrupted;
    const std::string before = headline_of(report_.before);
    switch (report_.answer) {
      case Answer::fine:
        document_.tone = Tone::good;
        document_.answer = fmt::format("NOTHING TO FIX: {}, discovery completes after {}.", before,
                                       completion_text(report_.before));
        return;
      case Answer::cured:
        document_.tone = Tone::good;
        document_.answer = fmt::format("CURED by {}: {}.", chosen()->name, from_to());
        return;
      case Answer::nothing_cures:
        document_.tone = Tone::bad;
        document_.exit_code = 1;
        document_.answer = fmt::format("NOTHING CURES IT: {}, and none of {} ends it. {}", before,
                                       known(), nearest_text());
        return;
      case Answer::unfinished:
        document_.tone = Tone::warn;
        document_.exit_code = 3;
        document_.answer = report_.before.runs.size() < request_.samples
                               ? std::string{"INTERRUPTED before it was known what it is like."}
                               : fmt::format("{} after {}: {} before. {}",
                                             report_.interrupted ? "INTERRUPTED" : "NO TIME LEFT",
                                             known(), before, nearest_text());
        return;
    }
  }

  [[nodiscard]] std::string from_to() const {
    const Cell& after = *report_.after();
    return fmt::format("{} → {}, {} → {} at the median", headline_of(report_.before),
                       headline_of(after), time_text(report_.before.completion.median),
                       time_text(after.completion.median));
  }
  [[nodiscard]] std::string nearest_text() const {
    if (chosen() == nullptr) return "Nothing that was tried is better than it is.";
    return fmt::format("Nearest comes {}: {}.", chosen()->name, from_to());
  }

  void verdict() {
    if (report_.before.runs.empty()) return;
    report::Facts facts;
    const auto add = [&](const char* when, const Cell& cell) {
      const exact::Outlook outlook = *trials::outlook_of(cell.runs);
      facts.rows.emplace_back(when,
                              report::badge(report::tone_of(outlook.health()), outlook.headline()) +
                                  fmt::format(": {}; {}", completion_text(cell), storm_text(cell)));
    };
    add("before", report_.before);
    if (const Cell* after = report_.after()) add("after", *after);
    if (chosen() != nullptr) facts.rows.emplace_back("change", change_text(*chosen()));
    if (!report_.untried.empty()) {
      std::vector<std::string> names;
      for (const Kind kind : report_.untried) names.emplace_back(name_of(kind));
      trials::Unasked unasked;
      unasked.left_out.push_back(fmt::format("more changes of {}", fmt::join(names, ", ")));
      add_unasked(facts, unasked);
    }
    document_.blocks.emplace_back(std::move(facts));
  }

  void tried() {
    if (report_.attempts.empty()) return;
    Table table{{{"what was tried"},
                 {"kind"},
                 {"completion", Column::Align::right},
                 {"worst", Column::Align::right},
                 {"messages", Column::Align::right},
                 {.head = "", .stays = true}},
                {}};
    table.caption = fmt::format("medians of {} runs", request_.trials);
    for (std::size_t k = 0; k < report_.attempts.size(); ++k) {
      const Attempt& made = report_.attempts[k];
      Table::Row line{{(k == report_.chosen ? "→ " : "") + made.name, name_of(made.kind)},
                      k == report_.chosen};
      if (!made.not_run.empty()) {
        line.cells.insert(line.cells.end(), 3, report::Text{"–"});
        line.cells.emplace_back("not run: " + made.not_run);
      } else {
        line.cells.emplace_back(time_text(made.runs.completion.median));
        line.cells.emplace_back(time_text(made.runs.completion.max));
        line.cells.emplace_back(report::count_figure(made.runs.messages.median));
        const exact::Outlook outlook = *trials::outlook_of(made.runs.runs);
        line.cells.push_back(report::badge(report::tone_of(outlook.health()), outlook.headline()));
      }
      table.rows.push_back(std::move(line));
    }
    document_.blocks.emplace_back(std::move(table));
  }

  void what_to_deploy() {
    const std::string words = checker::words_of(request_.scenario, request_.overrides);
    if (!context_.written.empty()) {
      document_.blocks.emplace_back(report::Facts{
          {{"files to deploy", fmt::format("{}", fmt::join(context_.written, ", "))}}});
      document_.blocks.emplace_back(
          report::Command{fmt::format("{}", fmt::join(context_.loading, "\n"))});
    } else if (chosen() != nullptr) {
      document_.next.push_back({report::program() + " fix " + words + " --export fix",
                                "the same, the files to deploy, and how to load them"});
    }
    if (report_.answer == Answer::nothing_cures) {
      document_.next.push_back({report::program() + " compare-discovery " + words,
                                "up to which size each way to discover works"});
    } else if (report_.answer == Answer::fine) {
      document_.next.push_back({report::program() + " fuzz " + words + " --loss 1%",
                                "whether that lasts when packets get lost"});
    }
  }

  void assumptions() {
    document_.assumptions.emplace_back(fmt::format(
        "Before and after are {} under the same seeds, which nothing was chosen by. Kinds of "
        "change "
        "are tried in this order until something cures: settings, discovery, launch, vendor.",
        report::plural(request_.samples, "run")));
    if (request_.start_jitter.count() > 0) {
      document_.assumptions.emplace_back(fmt::format("Each process starts up to {} later.",
                                                     report::duration(request_.start_jitter)));
    }
    if (report_.usual_hosts) {
      document_.assumptions.emplace_back(fmt::format(
          "The scenario says no hosts, so under launch plans programs take the processor time that "
          "was measured (hosts: {}).",
          trials::usual_hosts));
    }
    report::add_unmodelled(document_, report_.candidates.scenario.dds);
  }

  const Report& report_;
  const Request& request_;
  const Context& context_;
  Document document_;
};

}  // namespace

Document document_of(const Report& report, const Request& request, const Context& context) {
  return Builder{report, request, context}.build();
}

}  // namespace stormproof::fix
