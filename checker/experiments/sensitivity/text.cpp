// The text: two lines for each knob, one for each direction, with a bar from the unchanged result.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/experiments/sensitivity/report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::sensitivity {

namespace {

using report::left;
using report::right;

constexpr std::size_t half_bar = 14;

std::string amount(Measure measure, double value) {
  if (measure == Measure::completion) {
    return report::duration(model::Nanoseconds{std::llround(std::abs(value))});
  }
  // The median of an even number of runs may lie between two numbers.
  const double size = std::abs(value);
  const std::string whole = report::grouped(static_cast<std::uint64_t>(size));
  return size == std::floor(size) ? whole : whole + ".5";
}

std::string signed_amount(Measure measure, double value) {
  if (value == 0) return "0";
  return (value < 0 ? "−" : "+") + amount(measure, value);
}

std::string relative(double value, double base) {
  if (value == 0) return "0";
  if (base == 0) return "–";
  return fmt::format("{}{:.1f} %", value < 0 ? "−" : "+", std::abs(100 * value / base));
}

/// A bar to the left or right of the unchanged result; the greatest effect fills it.
std::string bar(double value, double greatest) {
  const double share = greatest > 0 ? std::abs(value) / greatest : 0;
  auto length = static_cast<std::size_t>(std::lround(share * static_cast<double>(half_bar)));
  if (value != 0) length = std::max<std::size_t>(length, 1);
  std::string blocks;
  for (std::size_t k = 0; k < length; ++k) blocks += "█";
  return value < 0 ? right(blocks, half_bar) + "│" + std::string(half_bar, ' ')
                   : std::string(half_bar, ' ') + "│" + left(blocks, half_bar);
}

std::string change_text(const KnobResult& knob, const LevelResult& level) {
  return knob.value + " → " + level.value;
}

class TextReport {
 public:
  TextReport(const Report& report, const Description& description)
      : report_{report}, description_{description}, options_{description.options} {}

  std::string write() {
    if (report_.knobs.empty()) return "Interrupted before any change was run.\n";
    write_head();
    write_knobs();
    write_silent();
    write_unvaried();
    write_pairs();
    write_notes();
    return out_;
  }

 private:
  void write_head() {
    out_ += fmt::format("{}: what a change of {:g} % does to {}\n\n", description_.scenario,
                        100 * options_.range, name_of(options_.by));
    out_ += fmt::format(
        "  unchanged  completion {}, {} messages{}\n", amount(Measure::completion, report_.base[0]),
        amount(Measure::messages, report_.base[1]), report_.samples > 1 ? " (medians)" : "");
    if (report_.incomplete > 0) {
      out_ += fmt::format(
          "             {} of {} runs do not complete; they count with the time limit\n",
          report_.incomplete, report_.samples);
    }
    out_ += fmt::format("  runs       {}", report::grouped(report_.runs));
    if (report_.samples > 1) {
      out_ += fmt::format(": {} for each change, seeds {} to {}, compared seed by seed",
                          report_.samples, options_.first_seed,
                          options_.first_seed + report_.samples - 1);
    }
    out_ += report_.finished ? "\n\n" : "; interrupted before all were done\n\n";
  }

  [[nodiscard]] bool is_silent(const KnobResult& knob) const {
    return knob.is_without_effect(Measure::completion) && knob.is_without_effect(Measure::messages);
  }

  void write_knobs() {
    const auto shown = std::min(description_.shown, report_.knobs.size());
    std::size_t width = 4;
    std::size_t change_width = 9;
    for (std::size_t k = 0; k < shown; ++k) {
      const KnobResult& knob = report_.knobs[k];
      if (is_silent(knob)) continue;
      width = std::max(width, knob.key.size());
      for (const auto& level : knob.levels) {
        if (level)
          change_width = std::max(change_width, report::columns(change_text(knob, *level)));
      }
    }
    const double greatest = report_.knobs.front().swing(options_.by);
    const bool by_completion = options_.by == Measure::completion;
    out_ +=
        fmt::format("  {} {} {} {} {} {}\n", left("knob", width), left("from → to", change_width),
                    right("completion", 10), right("messages", 9),
                    left(by_completion ? "    completion" : "    messages", 2 * half_bar + 1),
                    right(report_.samples > 1 ? "interval" : "effect", 24));
    std::size_t hidden = 0;
    for (std::size_t k = 0; k < report_.knobs.size(); ++k) {
      if (is_silent(report_.knobs[k])) continue;
      if (k < shown)
        write_knob(report_.knobs[k], width, change_width, greatest);
      else
        ++hidden;
    }
    if (hidden > 0) {
      out_ += fmt::format("  … and {} more with less effect (--top N, or --format json)\n", hidden);
    }
  }

  void write_knob(const KnobResult& knob, std::size_t width, std::size_t change_width,
                  double greatest) {
    std::string key = knob.key;
    for (const auto& level : knob.levels) {
      if (!level) continue;
      const Effect& effect = of(level->effects, options_.by);
      out_ += fmt::format(
          "  {} {} {} {} {} {}{}\n", left(key, width),
          left(change_text(knob, *level), change_width),
          right(relative(of(level->effects, Measure::completion).median, report_.base[0]), 10),
          right(relative(of(level->effects, Measure::messages).median, report_.base[1]), 9),
          bar(effect.median, greatest), right(interval(effect), 24), doubt(*level, effect));
      key.clear();
    }
  }

  [[nodiscard]] std::string interval(const Effect& effect) const {
    if (report_.samples == 1 || effect.exactly_zero) {
      return signed_amount(options_.by, effect.median);
    }
    return fmt::format("{} … {}", signed_amount(options_.by, effect.low),
                       signed_amount(options_.by, effect.high));
  }

  [[nodiscard]] std::string doubt(const LevelResult& level, const Effect& effect) const {
    std::string text;
    if (report_.samples > 1 && !effect.is_clear() && !effect.exactly_zero) text = "  unclear";
    if (level.incomplete > 0) {
      text += fmt::format("  {} of {} incomplete", level.incomplete, report_.samples);
    }
    return text;
  }

  void write_silent() {
    std::vector<std::string> keys;
    for (const KnobResult& knob : report_.knobs) {
      if (is_silent(knob)) keys.push_back(knob.key);
    }
    if (keys.empty()) return;
    out_ +=
        "\n" + report::paragraph("  no effect at all   ", fmt::format("{}", fmt::join(keys, ", ")));
  }

  void write_unvaried() {
    std::vector<std::string> keys;
    for (const KnobResult& knob : report_.unvaried) {
      keys.push_back(fmt::format("{} ({}: {})", knob.key, knob.value, knob.obstacle));
    }
    if (keys.empty()) return;
    out_ +=
        "\n" + report::paragraph("  not varied         ", fmt::format("{}", fmt::join(keys, ", ")));
  }

  void write_pairs() {
    if (report_.pairs.empty()) return;
    out_ +=
        fmt::format("\n  pairs: {} of both changes, and by how much that is more than the sum\n",
                    name_of(options_.by));
    for (const PairResult& pair : report_.pairs) {
      const Effect& interaction = of(pair.interaction, options_.by);
      const bool unclear =
          report_.samples > 1 && !interaction.is_clear() && !interaction.exactly_zero;
      out_ += fmt::format("  {} {} {}  {} × {}{}\n",
                          right(signed_amount(options_.by, of(pair.joint, options_.by).median), 11),
                          right(signed_amount(options_.by, interaction.median), 11),
                          right(report_.samples > 1 ? interval(interaction) : "", 24),
                          moved_key(pair, 0), moved_key(pair, 1), unclear ? "  unclear" : "");
    }
  }

  static std::string moved_key(const PairResult& pair, std::size_t which) {
    return pair.keys[which] + (pair.directions[which] == Direction::up ? " ↑" : " ↓");
  }

  void write_notes() {
    out_ += '\n';
    if (!description_.is_sampled()) {
      out_ += report::paragraph(
          "  Note: ",
          "each change is one trajectory. A storm is chaotic: any change moves it a little, so "
          "small effects here may be chance. --start-jitter 10ms --samples 20 runs every change "
          "with 20 different starts and shows which effects are clear.");
    } else if (report_.samples > 1) {
      const Effect& any = report_.knobs.front().levels[0]
                              ? of(report_.knobs.front().levels[0]->effects, options_.by)
                              : of(report_.knobs.front().levels[1]->effects, options_.by);
      out_ += report::paragraph(
          "  ", fmt::format("Effects are medians of the differences seed by seed, intervals are "
                            "those of the sign test, {:.1f} %. Unclear: the interval has both "
                            "signs.",
                            100 * any.confidence));
    }
    if (!description_.dds.unmodelled.empty()) {
      out_ += report::unmodelled_text(description_.dds) + "\n";
    }
    out_ += "  again: " + description_.command + "\n";
  }

  const Report& report_;
  const Description& description_;
  const Options& options_;
  std::string out_;
};

}  // namespace

std::string to_text(const Report& report, const Description& description) {
  return TextReport{report, description}.write();
}

}  // namespace stormproof::sensitivity
