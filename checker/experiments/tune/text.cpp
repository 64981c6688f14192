// The text: the answer first, then one line of numbers for each setting and what it changes, then
// how far the numbers go.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/experiments/tune/report.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::tune {

namespace {

using report::left;
using report::paragraph;
using report::right;

constexpr std::size_t name_width = 23;

std::string time(const std::optional<double>& value) {
  return value ? report::duration(model::Nanoseconds{std::llround(*value)}) : "never";
}

std::string count(const std::optional<double>& value) {
  return value ? report::grouped(static_cast<std::uint64_t>(std::llround(*value))) : "–";
}

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
  return fmt::format("{}{:.1f} %", percent < 0 ? "−" : "+", std::abs(percent));
}

/// "−52.1 % (−58.0 % … −46.3 %)".
std::string shift_text(const Shift& shift) {
  if (shift.exact || shift.low == shift.high) return percentage(shift.estimate);
  return fmt::format("{} ({} … {})", percentage(shift.estimate), percentage(shift.low),
                     percentage(shift.high));
}

class TextReport {
 public:
  TextReport(const Report& report, const Context& context) : report_{report}, context_{context} {}

  std::string write() {
    write_head();
    if (report_.rows.empty()) {
      return out_ + "Interrupted before anything was known.\n";
    }
    write_answer();
    write_table();
    write_settings();
    write_comparison();
    write_deployment();
    write_notes();
    return out_;
  }

 private:
  [[nodiscard]] const Row* recommended() const {
    return report_.recommended ? &report_.rows[*report_.recommended] : nullptr;
  }

  [[nodiscard]] bool has_front() const {
    return std::ranges::any_of(report_.rows,
                               [](const Row& row) { return row.kind == Row::Kind::front; });
  }

  void write_head() {
    out_ += fmt::format("{}: settings of {} ({}) that a user can change\n", context_.scenario,
                        model::config::vendor::name_of(context_.subject.vendor),
                        context_.subject.preset);
    for (const Dimension& d : report_.space.dimensions) {
      const auto print = [&](std::int64_t value) {
        return model::config::print_quantity(d.unit, value);
      };
      out_ += fmt::format("  {} {}, searched from {} to {}\n", left(d.key, 36), print(d.unchanged),
                          print(d.minimum), print(d.maximum));
    }
    out_ += '\n';
  }

  void write_answer() {
    const Row* best = recommended();
    const Row& unchanged = report_.rows.front();
    if (report_.answer == Answer::interrupted) {
      out_ += paragraph("INTERRUPTED  ",
                        best == nullptr || best->kind != Row::Kind::front
                            ? "nothing better was found so far."
                            : fmt::format("best known so far: {}. Its numbers come from the runs "
                                          "that chose it, so they flatter it.",
                                          settings_text(*best)));
      out_ += '\n';
      return;
    }
    if (report_.answer == Answer::nothing_better) {
      out_ += paragraph("NOTHING BETTER  ",
                        fmt::format("no setting was found that clearly shortens discovery ({}).{}",
                                    time(unchanged.summary.completion_ns.median),
                                    has_front() ? " What can be had for it is on the front." : ""));
      out_ += '\n';
      return;
    }
    out_ += paragraph("BETTER  ",
                      fmt::format("{} → {} (median) with {}: completion {}, messages {}.",
                                  time(unchanged.summary.completion_ns.median),
                                  time(best->summary.completion_ns.median), settings_text(*best),
                                  shift_text(best->against_unchanged->completion),
                                  shift_text(best->against_unchanged->messages)));
    out_ += '\n';
  }

  void write_table() {
    out_ += fmt::format("  {}{} {} {} {} {}\n", left("medians [10–90 %]", name_width),
                        right("completion", 11), right("", 21), right("messages", 10),
                        right("HEARTBEAT", 10), right("[10–90 %]", 18));
    for (std::size_t k = 0; k < report_.rows.size(); ++k) {
      const Row& row = report_.rows[k];
      const Summary& s = row.summary;
      const bool marked = report_.recommended == k && row.kind == Row::Kind::front;
      out_ += fmt::format(
          "{} {}{} {} {} {} {}{}\n", marked ? "→" : " ", left(row.name, name_width),
          right(time(s.completion_ns.median), 11),
          right(fmt::format("[{} – {}]", time(s.completion_ns.p10), time(s.completion_ns.p90)), 21),
          right(count(s.messages.median), 10), right(count(s.heartbeat.median), 10),
          right(fmt::format("[{} – {}]", count(s.heartbeat.p10), count(s.heartbeat.p90)), 18),
          remark(row));
    }
    out_ += '\n';
  }

  [[nodiscard]] std::string remark(const Row& row) const {
    std::string text;
    if (row.summary.completed < row.summary.runs) {
      text += fmt::format("  {} of {} incomplete", row.summary.runs - row.summary.completed,
                          row.summary.runs);
    }
    if (!row.broken.empty()) text += fmt::format("  breaks {}", fmt::join(row.broken, ", "));
    return text;
  }

  void write_settings() {
    for (const Row& row : report_.rows) {
      if (row.kind != Row::Kind::front) continue;
      std::string text = settings_text(row);
      if (row.against_unchanged) {
        text += fmt::format("; completion {}, messages {}",
                            shift_text(row.against_unchanged->completion),
                            shift_text(row.against_unchanged->messages));
        const Shift& gain = row.against_unchanged->completion;
        if (!gain.is_less() && !gain.is_more()) {
          text += "; in completion not to be told from unchanged";
        }
      }
      if (const auto file = context_.files.find(row.name); file != context_.files.end()) {
        text += "; " + file->second;
      }
      out_ += paragraph("  " + left(row.name, 9), text);
    }
    out_ += '\n';
  }

  void write_comparison() {
    const Row* best = recommended();
    if (best == nullptr || best->kind != Row::Kind::front) return;
    for (const Row& row : report_.rows) {
      if (row.kind != Row::Kind::comparison || !row.recommended_against) continue;
      out_ += paragraph(fmt::format("  {} against {}: ", best->name, row.name),
                        fmt::format("completion {}, messages {}. {}",
                                    shift_text(row.recommended_against->completion),
                                    shift_text(row.recommended_against->messages), row.note));
    }
    out_ += '\n';
  }

  void write_deployment() {
    if (context_.files_wanted && context_.files.empty()) {
      out_ += "  files    none was written\n\n";
    }
    if (context_.files.empty()) return;
    for (const std::string& what : context_.prerequisites) out_ += paragraph("  deploy   ", what);
    if (const Row* best = recommended()) {
      for (const Change& change : best->changes) {
        if (change.note.empty()) continue;
        out_ += paragraph("  note     ", fmt::format("{}: {}.", element(change), change.note));
      }
    }
    if (!context_.repeat.empty()) out_ += "  measure  " + context_.repeat + "\n";
    for (const std::string& line : context_.check) out_ += paragraph("  check    ", line);
    out_ += '\n';
  }

  void write_notes() {
    out_ += paragraph("  search   ", effort());
    out_ += paragraph("  kept     ", kept());
    if (report_.is_sampled && report_.answer != Answer::interrupted) {
      out_ += paragraph("  numbers  ",
                        fmt::format("medians of {} runs under seeds {} to {}, which nothing was "
                                    "chosen by. Percentages are Hodges–Lehmann estimates of the "
                                    "ratio seed by seed, with 95 % intervals.",
                                    report_.basis.count, report_.basis.first,
                                    report_.basis.first + report_.basis.count - 1));
    } else if (!report_.is_sampled) {
      out_ += paragraph("  numbers  ",
                        "every setting is one trajectory, and a storm is chaotic: small gains may "
                        "be chance. --start-jitter 10ms, or a deployment with a schedule, tells "
                        "which are not.");
    }
    out_ += paragraph(
        "  limits   ",
        "what is measured is the model (specs/guide/model.md, specs/guide/fastdds.md), not your "
        "network; specs/findings/interventions.md has what was predicted and "
        "measured for some of these settings.");
    for (const auto& [setting, effect] : context_.subject.scenario.dds.unmodelled) {
      out_ += paragraph("  assumed  ", fmt::format("{}: {}", setting, effect));
    }
    out_ += "  again    " + context_.command + "\n";
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
    return text + ".";
  }

  [[nodiscard]] std::string kept() const {
    std::string text = report_.kept.empty()
                           ? "nothing was required"
                           : fmt::format("in every run: {}", fmt::join(report_.kept, ", "));
    if (!report_.not_required.empty()) {
      text += fmt::format("; not required, as they break unchanged: {}",
                          fmt::join(report_.not_required, ", "));
    }
    return text + ". Properties of the transition tables do not depend on settings.";
  }

  const Report& report_;
  const Context& context_;
  std::string out_;
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

std::string to_text(const Report& report, const Context& context) {
  return TextReport{report, context}.write();
}

}  // namespace stormproof::tune
