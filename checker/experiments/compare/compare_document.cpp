// The comparison as a document: which way is best here, all of them at the scenario's own size, how
// far each goes, and how far that was held against live runs.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/experiments/compare/compare_report.hpp"
#include "checker/experiments/trials/tone_of_health.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/document/unreached.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/check/next_steps.hpp"

namespace stormproof::compare {

namespace {

using report::Column;
using report::Document;
using report::Facts;
using report::Paragraph;
using report::Table;
using report::Text;
using report::Tone;
using statistics::Quantiles;

std::string time_text(const std::optional<double>& ns) {
  return report::time_figure(ns, "> limit");
}

const Quantiles& figure_of(const Cell& cell, Figure figure) {
  return cell.figures[static_cast<std::size_t>(figure)];
}

std::string range_text(const Quantiles& q) {
  if (q.count < 2) return time_text(q.median);
  return fmt::format("{} [{} – {}]", time_text(q.median), time_text(q.min), time_text(q.max));
}

bool has_runs(const Row& row) {
  return std::ranges::any_of(row.cells, [](const Cell& cell) { return !cell.runs.empty(); });
}

class Builder {
 public:
  Builder(const Report& report, const Request& request) : report_{report}, request_{request} {}

  Document build() {
    head();
    at_own_size();
    if (std::string text = report::unreached(report_.candidates.scenario); !text.empty()) {
      document_.blocks.emplace_back(Paragraph{"As it is: " + text, Tone::warn});
    }
    as_it_grows();
    if (report_.sizes.size() > 1) plots();
    what_to_do();
    measured();
    how();
    assumptions();
    return std::move(document_);
  }

 private:
  [[nodiscard]] const Cell& own_cell(const Row& row) const {
    return row.cells[report_.own_index()];
  }

  /// The candidate whose median completion is least at the own size; of those alone that do not
  /// break, if that is asked.
  [[nodiscard]] const Row* fastest(bool without_breaking) const {
    const Row* best = nullptr;
    const auto completion = [this](const Row& row) {
      return figure_of(own_cell(row), Figure::completion).median;
    };
    for (const Row& row : report_.rows) {
      const Cell& cell = own_cell(row);
      if (cell.runs.empty() || !is_known(cell)) continue;  // half of the runs is no median
      if ((without_breaking && cell.breaks) || !completion(row)) continue;
      if (best == nullptr || *completion(row) < *completion(*best)) best = &row;
    }
    return best;
  }

  /// Whether every run of the row at the own size, or at all sizes, was made or is not to be made.
  [[nodiscard]] bool is_known(const Cell& cell) const {
    return cell.runs.size() == report_.samples || (cell.runs.empty() && !cell.interrupted);
  }
  [[nodiscard]] bool is_known(const Row& row) const {
    return std::ranges::all_of(row.cells, [this](const Cell& cell) { return is_known(cell); });
  }
  [[nodiscard]] std::size_t known_at_own_size() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        report_.rows, [this](const Row& row) { return is_known(own_cell(row)); }));
  }

  [[nodiscard]] const Row* own() const {
    const auto found =
        std::ranges::find_if(report_.rows, [](const Row& row) { return row.candidate.is_own; });
    return found == report_.rows.end() ? nullptr : &*found;
  }

  void head() {
    document_.title = "stormproof compare-discovery " + request_.scenario;
    document_.complete = !report_.interrupted;
    document_.exit_code = report_.interrupted ? 3 : 0;
    const Row* best = fastest(false);
    document_.tone = report_.interrupted || fastest(true) == nullptr ? Tone::warn : Tone::info;
    document_.subject =
        fmt::format("{}: {} ways to discover on the same start times, {} {}", request_.scenario,
                    report_.rows.size(), fmt::join(report_.sizes, ", "), words_of(report_.grows));
    const std::string where = fmt::format("With {} {}", report_.own_size, words_of(report_.grows));
    const std::size_t known = known_at_own_size();
    if (known < report_.rows.size()) {
      document_.answer =
          fmt::format("INTERRUPTED after {} of {} ways at this size.{}", known, report_.rows.size(),
                      best == nullptr ? "" : " So far: " + answer(where, *best));
    } else if (best == nullptr) {
      document_.answer = fmt::format("{} no way to discover completes within {}.", where,
                                     report::duration(report_.limit));
    } else {
      document_.answer = answer(where, *best);
    }
    document_.elaboration = furthest();
    if (report_.interrupted && known == report_.rows.size()) {
      document_.elaboration += " Not all sizes were run: where each breaks is not known.";
    }
  }

  /// Which way is fastest, and, if that one breaks, which is of those that do not.
  [[nodiscard]] std::string answer(const std::string& where, const Row& best) const {
    const Cell& least = own_cell(best);
    std::string text =
        fmt::format("{} {} is fastest: discovery completes after {} at the median{}", where,
                    best.candidate.name, time_text(figure_of(least, Figure::completion).median),
                    beside(&best, own()));
    if (!least.breaks) return text + ".";
    const Row* whole = fastest(true);
    if (whole == nullptr) return text + fmt::format(". It breaks ({}), as all do.", least.outcome);
    return text + fmt::format(". It breaks ({}); of those that do not, {} is fastest, after {}.",
                              least.outcome, whole->candidate.name,
                              time_text(figure_of(own_cell(*whole), Figure::completion).median));
  }

  [[nodiscard]] std::string beside(const Row* best, const Row* now) const {
    if (now == nullptr || now == best || own_cell(*now).runs.empty()) return {};
    const Cell& cell = own_cell(*now);
    const std::string whose =
        now->candidate.id == "as-it-is" ? "" : fmt::format(" ({})", now->candidate.name);
    return fmt::format(", as it is{} after {}{}", whose,
                       time_text(figure_of(cell, Figure::completion).median),
                       cell.breaks ? ": " + cell.outcome : "");
  }

  [[nodiscard]] std::string furthest() const {
    std::vector<std::string> whole;
    bool all_known = true;
    for (const Row& row : report_.rows) {
      all_known = all_known && is_known(row);
      if (has_runs(row) && is_known(row) && !row.breaks_at) whole.push_back(row.candidate.name);
    }
    if (report_.sizes.size() < 2) return {};
    if (!all_known && whole.empty()) return {};
    return whole.empty() ? fmt::format("All of them break up to {} {}.", report_.sizes.back(),
                                       words_of(report_.grows))
                         : fmt::format("Up to {} {} these do not break: {}.", report_.sizes.back(),
                                       words_of(report_.grows), fmt::join(whole, ", "));
  }

  void at_own_size() {
    Table table{{{"way to discover"}, {"completion [range]", Column::Align::right}}, {}};
    for (const char* name : {"messages", "repair", "HEARTBEAT", "ACKNACK"}) {
      table.columns.push_back({name, Column::Align::right});
    }
    for (const char* name : {"initial", "announced"}) {
      table.columns.push_back({name, Column::Align::right, false, report::Audience::verbose});
    }
    table.columns.push_back({"", Column::Align::left, true});
    table.wide = true;
    table.caption =
        fmt::format("{} {}: {}", report_.own_size, words_of(report_.grows),
                    report_.samples == 1 ? std::string{"one run of each"}
                                         : fmt::format("medians of {} runs", report_.samples));
    for (const Row& row : report_.rows) {
      const Cell& cell = own_cell(row);
      Table::Row line{{(row.candidate.is_own ? "→ " : "") + row.candidate.name},
                      row.candidate.is_own};
      if (cell.runs.empty()) {
        line.cells.insert(line.cells.end(), 7, Text{"–"});
        line.cells.emplace_back(cell.not_run);
      } else {
        line.cells.emplace_back(range_text(figure_of(cell, Figure::completion)));
        for (const Figure figure : {Figure::messages, Figure::repair_data, Figure::heartbeat,
                                    Figure::acknack, Figure::initial_data, Figure::announcements}) {
          line.cells.emplace_back(report::count_figure(figure_of(cell, figure).median));
        }
        line.cells.push_back(report::badge(report::tone_of(cell.health), cell.outcome));
      }
      table.rows.push_back(std::move(line));
    }
    document_.blocks.emplace_back(std::move(table));
    if (std::string svg = classes_plot(report_); !svg.empty()) {
      document_.blocks.emplace_back(report::Drawing{std::move(svg), "Messages by class"},
                                    report::Audience::page);
    }
  }

  void as_it_grows() {
    if (report_.sizes.size() < 2) return;
    Table table{{{"completion, messages"}}, {}};
    for (const std::uint32_t size : report_.sizes) {
      table.columns.push_back({std::to_string(size), Column::Align::right});
    }
    table.columns.push_back({.head = "breaks at", .align = Column::Align::right, .stays = true});
    table.wide = true;
    table.caption = fmt::format("medians as {} grow", words_of(report_.grows));
    for (const Row& row : report_.rows) {
      Table::Row line{{row.candidate.name}};
      for (const Cell& cell : row.cells) {
        line.cells.emplace_back(
            cell.runs.empty()
                ? "–"
                : fmt::format("{}{}, {}", cell.breaks ? "✗ " : "",
                              time_text(figure_of(cell, Figure::completion).median),
                              report::count_figure(figure_of(cell, Figure::messages).median)));
      }
      std::string where = row.breaks_at ? std::to_string(*row.breaks_at) : "not here";
      if (!is_known(row) && !row.breaks_at) where = "?";
      if (!has_runs(row)) where = "–";
      line.cells.emplace_back(where);
      table.rows.push_back(std::move(line));
    }
    document_.blocks.emplace_back(std::move(table));
    document_.blocks.emplace_back(Paragraph{fmt::format(
        "A way breaks (✗) at the first size at which half of the runs {}; larger ones are not run.",
        limit_text())});
  }

  [[nodiscard]] std::string limit_text() const {
    const auto& limits = report_.candidates.scenario.limits;
    if (limits && limits->completion) {
      return fmt::format("are not complete after {} (limits.completion)",
                         report::duration(*limits->completion));
    }
    return fmt::format("storm, or are not complete within {}", report::duration(report_.limit));
  }

  void plots() {
    for (const Figure figure : {Figure::completion, Figure::messages}) {
      document_.blocks.emplace_back(report::Drawing{growth_plot(report_, figure), ""},
                                    report::Audience::page);
    }
  }

  void what_to_do() {
    Table table{{{"way to discover"}, {"what to change", Column::Align::left, true}, {"profile"}},
                {}};
    std::vector<std::string> files;
    for (const Row& row : report_.rows) {
      const Candidate& one = row.candidate;
      std::string what = one.change;
      if (!one.note.empty()) what += " (" + one.note + ")";
      table.rows.push_back({{one.name, what, one.profile}});
      files.insert(files.end(), row.files.begin(), row.files.end());
    }
    document_.blocks.emplace_back(std::move(table));
    if (!files.empty()) {
      document_.blocks.emplace_back(
          Facts{{{"files to deploy", fmt::format("{}", fmt::join(files, ", "))}}});
    } else {
      document_.next.push_back({report::program() + " compare-discovery " +
                                    checker::words_of(request_.scenario, request_.overrides) +
                                    " --export ways",
                                "the files to deploy each of them"});
    }
  }

  /// How far each was held against live runs.
  void measured() {
    Table table{{{"way to discover"},
                 {"held against live runs", Column::Align::left, true},
                 {"completion", Column::Align::right},
                 {"messages", Column::Align::right}},
                {}};
    const auto ratio = [](const Nearness& one) {
      return fmt::format("× {:.2f} (± {:.2f})", one.ratio, one.deviation);
    };
    for (const Row& row : report_.rows) {
      const auto found = report_.validated.find(row.candidate.measured);
      if (found == report_.validated.end()) {
        table.rows.push_back({{row.candidate.name, "no: nobody measured it", "–", "–"}});
        continue;
      }
      const Measured& one = found->second;
      table.rows.push_back(
          {{row.candidate.name, fmt::format("{}; {} configurations", one.what, one.configurations),
            ratio(one.completion), ratio(one.messages)}});
    }
    table.caption =
        "model over measurement: median ratio (median of |ln ratio|), of deployments with up to "
        "two hosts with six participants each";
    document_.blocks.emplace_back(
        report::Section{"How far to trust it", "trust", {std::move(table)}});
  }

  void how() {
    const bool storms = std::ranges::any_of(report_.rows, [](const Row& row) {
      return std::ranges::any_of(row.cells, [](const Cell& cell) {
        return std::ranges::any_of(cell.runs, [](const trials::Sample& run) {
          return run.health.health == exact::Health::storm;
        });
      });
    });
    report::add_definition(document_.blocks, storms, report_.candidates.scenario.limits);
    document_.blocks.emplace_back(Paragraph{
        report_.is_sampled
            ? fmt::format("Run k of every way and size draws its start times from seed {} + k.",
                          request_.seed)
            : "Every way runs the start times of the scenario once, and a storm is chaotic: "
              "--start-jitter 10ms, or a deployment with a schedule, shows the range."});
  }

  void assumptions() {
    document_.assumptions.emplace_back(
        "A larger deployment starts as the scenario says; more processes on a host may take "
        "longer.");
    document_.assumptions.emplace_back(
        "A Discovery Server is on a wireless host, with 50 µs for each datagram unless "
        "deployment.send_cost says otherwise; its clients are complete when they know what they "
        "match, all others when everybody knows everything.");
    if (const Row* now = own()) report::add_unmodelled(document_, now->candidate.dds);
  }

  const Report& report_;
  const Request& request_;
  Document document_;
};

}  // namespace

Document document_of(const Report& report, const Request& request) {
  return Builder{report, request}.build();
}

}  // namespace stormproof::compare
