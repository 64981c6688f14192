// A tuning as a document: the answer first, then one row of numbers for each setting and what it
// changes, then how far the numbers go.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/experiments/tune/tune_report.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/check/next_steps.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::tune {

namespace {

using report::Column;
using report::Document;
using report::Facts;
using report::Paragraph;
using report::Table;
using report::Text;
using report::Tone;

std::string count(const std::optional<double>& value) { return report::count_figure(value); }

/// The last element of a path of elements, with its parent; the name of a property.
std::string element(const Change& change) {
  const std::string& setting = change.setting;
  if (setting.empty()) return change.key;
  const std::size_t bracket = setting.find('[');
  if (bracket != std::string::npos)
    return setting.substr(bracket + 1, setting.size() - bracket - 2);
  const std::size_t slash = setting.rfind('/');
  if (slash == std::string::npos || slash == 0) return setting;
  const std::string last = setting.substr(slash + 1);
  if (last != "count" && last != "period") return last;
  const std::size_t parent = setting.rfind('/', slash - 1);
  return parent == std::string::npos ? setting : setting.substr(parent + 1);
}

/// "−52.1 %" for the logarithm of a ratio of 0.479.
std::string percentage(double logarithm) {
  const double percent = 100 * std::expm1(logarithm);
  if (percent == 0) return "±0 %";
  if (std::isinf(percent)) return "+∞";
  return fmt::format("{}{:.1f} %", percent < 0 ? "−" : "+", std::abs(percent));
}

/// "−52.1 % (−58.0 % … −46.3 %)".
std::string shift_text(const Shift& shift) {
  if (shift.exact || shift.low == shift.high) return percentage(shift.estimate);
  return fmt::format("{} ({} … {})", percentage(shift.estimate), percentage(shift.low),
                     percentage(shift.high));
}

/// "[2.483 s – 7.798 s]": the 10 to 90 % range.
template <class Print>
std::string range_text(const statistics::Quantiles& q, Print print) {
  return fmt::format("[{} – {}]", print(q.p10), print(q.p90));
}

class Builder {
 public:
  Builder(const Report& report, const Context& context) : report_{report}, context_{context} {}

  Document build() {
    head();
    if (report_.rows.empty()) {
      document_.answer = "Interrupted before anything was known.";
      return std::move(document_);
    }
    document_.answer = answer();
    searched();
    numbers();
    settings();
    deployment();
    notes();
    next();
    report::add_unmodelled(document_, context_.subject.scenario.dds);
    return std::move(document_);
  }

 private:
  [[nodiscard]] const Row* recommended() const {
    return report_.recommended ? &report_.rows[*report_.recommended] : nullptr;
  }

  /// Of a completion.
  [[nodiscard]] std::string time(const std::optional<double>& value) const {
    const bool is_cut = report_.compared_until < context_.subject.scenario.time_limit;
    return report::time_figure(value, is_cut ? longer_.c_str() : "never");
  }

  [[nodiscard]] bool is_recommended(const Row& row) const {
    return &row == recommended() && row.kind == Row::Kind::front;
  }

  /// Whether nobody has to wait with the recommended setting.
  [[nodiscard]] bool is_cured() const {
    const Row* best = recommended();
    return report_.answer != Answer::better || !best->outlook ||
           best->outlook->health() == exact::Health::fine;
  }

  [[nodiscard]] bool has_front() const {
    return std::ranges::any_of(report_.rows,
                               [](const Row& row) { return row.kind == Row::Kind::front; });
  }

  void head() {
    const bool interrupted = report_.answer == Answer::interrupted;
    document_.title = "stormproof tune " + context_.scenario;
    document_.complete = !interrupted;
    document_.exit_code = interrupted ? 3 : context_.newly_violated ? 1 : 0;
    document_.tone = interrupted                        ? Tone::warn
                     : context_.newly_violated          ? Tone::bad
                     : report_.answer == Answer::better ? (is_cured() ? Tone::good : Tone::warn)
                                                        : Tone::info;
    document_.subject = fmt::format(
        "{}: settings of {} ({}) that a user can change", context_.scenario,
        model::config::vendor::name_of(context_.subject.vendor), context_.subject.preset);
  }

  [[nodiscard]] std::string answer() const {
    const Row* best = recommended();
    const Row& unchanged = report_.rows.front();
    if (report_.answer == Answer::interrupted) {
      return "INTERRUPTED: " +
             (best == nullptr || best->kind != Row::Kind::front
                  ? "nothing better was found so far."
                  : fmt::format("best known so far: {}. Its numbers come from the runs that chose "
                                "it, so they flatter it.",
                                settings_text(*best)));
    }
    if (report_.answer == Answer::nothing_better) {
      return fmt::format(
          "NOTHING BETTER: no setting was found that clearly shortens discovery ({}).{}",
          time(unchanged.summary.completion_ns.median),
          has_front() ? " What can be had for it is on the front." : "");
    }
    return fmt::format("BETTER: {} → {} (median) with {}: completion {}, messages {}. {}",
                       time(unchanged.summary.completion_ns.median),
                       time(best->summary.completion_ns.median), settings_text(*best),
                       shift_text(best->against_unchanged->completion),
                       shift_text(best->against_unchanged->messages), afterwards());
  }

  /// Whether it works with the recommended setting.
  [[nodiscard]] std::string afterwards() const {
    const Row* best = recommended();
    if (!best->outlook) return {};
    const std::string after = best->outlook->headline() + ": " + best->outlook->sentence();
    if (is_cured()) return "With it: " + after + ".";
    return fmt::format("With it, still: {}. Settings alone do not cure it.", after);
  }

  /// What comes after: the file, and other ways to discover if settings do not do.
  void next() {
    if (report_.answer == Answer::interrupted) return;
    const std::string words = checker::words_of(context_.scenario, context_.overrides);
    if (!context_.files_wanted && report_.answer == Answer::better) {
      document_.next.push_back({report::program() + " tune " + words + " -o tuned",
                                "the same, and the files to deploy"});
    }
    if (!is_cured() || report_.answer == Answer::nothing_better) {
      document_.next.push_back({report::program() + " compare-discovery " + words,
                                "other ways to discover, which may do what settings do not"});
    }
  }

  void searched() {
    Facts facts;
    for (const Dimension& d : report_.space.dimensions) {
      facts.rows.emplace_back(d.key, fmt::format("{}, searched from {} to {}", d.print(d.unchanged),
                                                 d.print(d.minimum), d.print(d.maximum)));
    }
    document_.blocks.emplace_back(std::move(facts));
  }

  void numbers() {
    Table table{{{"medians [10–90 %]"}}, {}};
    for (const char* head : {"completion", "[10–90 %]", "messages", "HEARTBEAT", "[10–90 %]"}) {
      table.columns.push_back({head, Column::Align::right});
    }
    table.columns.push_back({""});
    for (const Row& row : report_.rows) {
      const Summary& s = row.summary;
      const bool marked = is_recommended(row);
      const auto range = range_text(s.completion_ns, [this](const auto& ns) { return time(ns); });
      table.rows.push_back({{(marked ? "→ " : "") + row.name, time(s.completion_ns.median), range,
                             count(s.messages.median), count(s.heartbeat.median),
                             range_text(s.heartbeat, count), remark(row)},
                            marked});
    }
    document_.blocks.emplace_back(std::move(table));
    document_.blocks.emplace_back(
        report::Drawing{to_svg(report_, context_), "Completion against messages"},
        report::Audience::page);
  }

  [[nodiscard]] static std::string remark(const Row& row) {
    std::string text;
    if (row.summary.completed < row.summary.runs) {
      text += fmt::format("{} of {} incomplete", row.summary.runs - row.summary.completed,
                          row.summary.runs);
    }
    if (!row.broken.empty()) {
      text += fmt::format("{}breaks {}", text.empty() ? "" : "; ", fmt::join(row.broken, ", "));
    }
    return text;
  }

  /// What each setting of the front changes, and the recommended one beside the comparisons.
  void settings() {
    Facts facts;
    for (const Row& row : report_.rows) {
      if (row.kind == Row::Kind::front) facts.rows.emplace_back(row.name, setting(row));
    }
    const Row* best = recommended();
    for (const Row& row : report_.rows) {
      if (best == nullptr || best->kind != Row::Kind::front) break;
      if (row.kind != Row::Kind::comparison || !row.recommended_against) continue;
      facts.rows.emplace_back(fmt::format("{} against {}", best->name, row.name),
                              fmt::format("completion {}, messages {}. {}",
                                          shift_text(row.recommended_against->completion),
                                          shift_text(row.recommended_against->messages), row.note));
    }
    if (!facts.rows.empty()) document_.blocks.emplace_back(std::move(facts));
  }

  [[nodiscard]] std::string setting(const Row& row) const {
    std::string text = settings_text(row);
    if (row.against_unchanged) {
      const Shift& gain = row.against_unchanged->completion;
      text += fmt::format("; completion {}, messages {}", shift_text(gain),
                          shift_text(row.against_unchanged->messages));
      if (!gain.is_less() && !gain.is_more()) {
        text += "; in completion not to be told from unchanged";
      }
    }
    if (const auto file = context_.files.find(row.name); file != context_.files.end()) {
      text += "; " + file->second;
    }
    return text;
  }

  void deployment() {
    Facts facts;
    const auto add = [&facts](const char* label, Text text) {
      facts.rows.emplace_back(label, std::move(text));
    };
    if (context_.files_wanted && context_.files.empty()) add("files", "none was written");
    if (!context_.files.empty()) {
      for (const std::string& what : context_.prerequisites) add("deploy", what);
      if (const Row* best = recommended()) {
        for (const Change& change : best->changes) {
          if (change.note.empty()) continue;
          add("note", fmt::format("{}: {}.", element(change), change.note));
        }
      }
      for (const std::string& line : context_.loading) add("load", report::code(line));
      if (!context_.repeat.empty()) add("measure", report::code(context_.repeat));
    }
    for (const std::string& line : context_.check) add("check", line);
    if (!facts.rows.empty()) document_.blocks.emplace_back(std::move(facts));
  }

  void notes() {
    Facts facts;
    facts.rows.emplace_back("search", effort());
    add_unasked(facts, report_.unasked);
    facts.rows.emplace_back("kept", kept());
    if (report_.is_sampled && report_.answer != Answer::interrupted) {
      facts.rows.emplace_back(
          "numbers",
          fmt::format("medians of {} runs under seeds {} to {}, which nothing was chosen by. "
                      "Percentages are medians of the ratio seed by seed, with "
                      "95 % intervals.",
                      report_.basis.count, report_.basis.first,
                      report_.basis.first + report_.basis.count - 1));
    } else if (!report_.is_sampled) {
      facts.rows.emplace_back(
          "numbers",
          "every setting is one trajectory, and a storm is chaotic: small gains may be chance. "
          "--start-jitter 10ms, or a deployment with a schedule, tells which are not.");
    }
    facts.rows.emplace_back(
        "limits",
        "what is measured is the model (specs/guide/model.md, specs/guide/fastdds.md), not your "
        "network; specs/findings/interventions.md has what was predicted and measured for some of "
        "these settings.");
    document_.blocks.emplace_back(std::move(facts));
  }

  [[nodiscard]] std::string effort() const {
    const SearchResult& found = report_.found;
    std::string text = fmt::format(
        "{} runs of {} settings, {} of them under all {} seeds; {} changes that do not matter were "
        "set back",
        report::grouped(report_.runs), report::grouped(report_.settings), found.finalists.size(),
        report_.searched.count, report_.undone);
    if (report_.dropped > 0) {
      text +=
          fmt::format("; {} settings of the front did not stand under new seeds", report_.dropped);
    }
    if (found.rejected > 0) {
      std::vector<std::string> by;
      for (const auto& [id, times] : found.rejected_by)
        by.push_back(fmt::format("{} {}", id, times));
      text += fmt::format("; {} settings were refused ({})", found.rejected, fmt::join(by, ", "));
    }
    if (report_.chosen.count > statistics::fewest_pairs(early_confidence)) {
      text += "; what was clearly worse after a part of its runs was not set back, and had no more";
    }
    return text + ".";
  }

  [[nodiscard]] std::string kept() const {
    std::string text = report_.kept.empty()
                           ? "nothing was required"
                           : fmt::format("in every run that the answer rests on: {}",
                                         fmt::join(report_.kept, ", "));
    if (!report_.not_required.empty()) {
      text += fmt::format("; not required, as they break unchanged: {}",
                          fmt::join(report_.not_required, ", "));
    }
    return text + ". Properties of the transition tables do not depend on settings.";
  }

  const Report& report_;
  const Context& context_;
  const std::string longer_ = "> " + report::duration(report_.compared_until);
  Document document_;
};

}  // namespace

std::string settings_text(const Row& row) {
  if (row.changes.empty()) return "no change";
  std::vector<std::string> parts;
  for (const Change& change : row.changes) {
    parts.push_back(fmt::format("{} {}", element(change), change.after));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

Document document_of(const Report& report, const Context& context) {
  return Builder{report, context}.build();
}

}  // namespace stormproof::tune
