// The ranking as a document: two rows for each knob, one for each direction, with bars to both
// sides of the unchanged result; pages have the tornado plot.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/implementations.hpp"

namespace stormproof::sensitivity {

namespace {

namespace vendor = model::config::vendor;
using report::Column;
using report::Document;
using report::Paragraph;
using report::Section;
using report::Table;

constexpr std::size_t longest_bar = 14;
constexpr auto to_right = Column::Align::right;

std::string amount(Measure measure, double value) {
  if (std::isinf(value)) return "∞";
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
  if (std::isinf(value)) return value < 0 ? "−∞" : "+∞";
  if (base == 0 || std::isinf(base)) return "–";
  return fmt::format("{}{:.1f} %", value < 0 ? "−" : "+", std::abs(100 * value / base));
}

/// As long as the effect; the greatest one has `longest_bar` blocks.
std::string bar(double value, double greatest) {
  const bool fills = std::abs(value) == greatest;  // so do infinite ones
  const double share = greatest > 0 ? (fills ? 1 : std::abs(value) / greatest) : 0;
  return report::bar(share, longest_bar);
}

std::string change_text(const KnobResult& knob, const LevelResult& level) {
  return knob.value + " → " + level.value;
}

bool is_silent(const KnobResult& knob) {
  return knob.is_without_effect(Measure::completion) && knob.is_without_effect(Measure::messages);
}

std::string moved_key(const PairResult& pair, std::size_t which) {
  return pair.keys[which] + (pair.directions[which] == Direction::up ? " ↑" : " ↓");
}

class Builder {
 public:
  Builder(const Report& report, const Description& description)
      : report_{report}, description_{description}, options_{description.options} {}

  Document build() {
    head();
    if (report_.knobs.empty()) return std::move(document_);
    knobs();
    lists();
    pairs();
    notes();
    report::add_unmodelled(document_, description_.dds);
    return std::move(document_);
  }

 private:
  void head() {
    document_.title = "stormproof sensitivity " + description_.scenario;
    document_.complete = report_.finished;
    document_.exit_code = report_.finished ? 0 : 3;
    document_.tone = report_.finished ? report::Tone::info : report::Tone::warn;
    document_.subject = fmt::format("{}: what a change of {:g} % does to {}", description_.scenario,
                                    100 * options_.range, name_of(options_.by));
    if (report_.knobs.empty()) {
      document_.answer = "Interrupted before any change was run.";
      return;
    }
    document_.answer = answer();
    report::Facts facts;
    std::string unchanged = fmt::format(
        "completion {}, {} messages{}", amount(Measure::completion, report_.base[0]),
        amount(Measure::messages, report_.base[1]), report_.samples > 1 ? " (medians)" : "");
    if (report_.incomplete > 0) {
      unchanged +=
          fmt::format("; {} of {} runs do not complete; they count as longer than all that do",
                      report_.incomplete, report_.samples);
    }
    std::string runs = report::grouped(report_.runs);
    if (report_.samples > 1) {
      runs += fmt::format(": {} for each change, seeds {} to {}, compared seed by seed",
                          report_.samples, options_.first_seed,
                          options_.first_seed + report_.samples - 1);
    }
    if (!report_.finished) runs += "; interrupted before all were done";
    facts.rows = {{"unchanged", unchanged}, {"runs", runs}};
    add_unasked(facts, report_.unasked);
    document_.blocks.emplace_back(std::move(facts));
  }

  /// The knob with the greatest effect.
  [[nodiscard]] std::string answer() const {
    const KnobResult& first = report_.knobs.front();
    if (first.is_without_effect(options_.by)) {
      return fmt::format("No change of one knob changes {}.", name_of(options_.by));
    }
    return fmt::format("{} matters most: a change of {:g} % moves {} by up to {}.", first.key,
                       100 * options_.range, name_of(options_.by),
                       amount(options_.by, first.swing(options_.by)));
  }

  /// Bars of blocks are for terminals; pages have a chart.
  void knobs() {
    constexpr auto terminal = report::Audience::terminal;
    Table table{
        {{"knob"},
         {"from → to"},
         {"completion", to_right},
         {"messages", to_right},
         {"less", to_right, false, terminal},
         {std::string{"more "} + name_of(options_.by), Column::Align::left, false, terminal},
         {report_.samples > 1 ? "interval" : "effect", to_right},
         {""}},
        {}};
    table.wide = true;
    const double greatest = report_.knobs.front().swing(options_.by);
    std::size_t hidden = 0;
    for (std::size_t k = 0; k < report_.knobs.size(); ++k) {
      if (is_silent(report_.knobs[k])) continue;
      if (k < description_.shown) {
        add(table, report_.knobs[k], greatest);
      } else {
        ++hidden;
      }
    }
    document_.blocks.emplace_back(std::move(table));
    if (hidden > 0) {
      document_.blocks.emplace_back(Paragraph{
          fmt::format("… and {} more with less effect (--top N, or --format json)", hidden)});
    }
    document_.blocks.emplace_back(
        report::Drawing{to_svg(report_, description_), "The first knobs, and where they lead"},
        report::Audience::page);
  }

  void add(Table& table, const KnobResult& knob, double greatest) const {
    std::string key = knob.key;
    for (const auto& level : knob.levels) {
      if (!level) continue;
      const Effect& effect = of(level->effects, options_.by);
      table.rows.push_back(
          {{key, change_text(knob, *level),
            relative(of(level->effects, Measure::completion).median, report_.base[0]),
            relative(of(level->effects, Measure::messages).median, report_.base[1]),
            effect.median < 0 ? bar(effect.median, greatest) : "",
            effect.median > 0 ? bar(effect.median, greatest) : "", interval(effect),
            doubt(*level, effect)}});
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

  [[nodiscard]] bool is_unclear(const Effect& effect) const {
    return report_.samples > 1 && !effect.is_clear() && !effect.exactly_zero;
  }

  [[nodiscard]] std::string doubt(const LevelResult& level, const Effect& effect) const {
    std::string text = is_unclear(effect) ? "unclear" : "";
    if (level.incomplete > 0) {
      text += fmt::format("{}{} of {} incomplete", text.empty() ? "" : "; ", level.incomplete,
                          report_.samples);
    }
    return text;
  }

  /// The knobs that do nothing, and those that were not varied.
  void lists() {
    std::vector<std::string> silent;
    std::vector<std::string> unvaried;
    for (const KnobResult& knob : report_.knobs) {
      if (is_silent(knob)) silent.push_back(knob.key);
    }
    for (const KnobResult& knob : report_.unvaried) {
      unvaried.push_back(fmt::format("{} ({}: {})", knob.key, knob.value, knob.obstacle));
    }
    report::Facts facts;
    const auto add_list = [&facts](const char* label, const std::vector<std::string>& list) {
      if (!list.empty()) facts.rows.emplace_back(label, fmt::format("{}", fmt::join(list, ", ")));
    };
    add_list("no effect at all", silent);
    add_list("not varied", unvaried);
    if (!facts.rows.empty()) document_.blocks.emplace_back(std::move(facts));
  }

  void pairs() {
    if (report_.pairs.empty()) return;
    Table table{{{"both changes", to_right}, {"more than the sum", to_right}}, {}};
    const bool sampled = report_.samples > 1;
    if (sampled) table.columns.push_back({"interval", to_right});
    table.columns.push_back({"pair"});
    table.columns.push_back({""});
    for (const PairResult& pair : report_.pairs) {
      const Effect& interaction = of(pair.interaction, options_.by);
      Table::Row row{{signed_amount(options_.by, of(pair.joint, options_.by).median),
                      signed_amount(options_.by, interaction.median)}};
      if (sampled) row.cells.emplace_back(interval(interaction));
      row.cells.emplace_back(moved_key(pair, 0) + " × " + moved_key(pair, 1));
      row.cells.emplace_back(is_unclear(interaction) ? "unclear" : "");
      table.rows.push_back(std::move(row));
    }
    document_.blocks.emplace_back(
        Section{fmt::format("pairs: {} of both changes, and by how much that is more than the sum",
                            name_of(options_.by)),
                "pairs",
                {std::move(table)}});
  }

  void notes() {
    if (!description_.is_sampled()) {
      document_.blocks.emplace_back(Paragraph{
          "Note: each change is one trajectory. A storm is chaotic: any change moves it a little, "
          "so small effects here may be chance. --start-jitter 10ms --samples 20 runs every change "
          "with 20 different starts and shows which effects are clear."});
    } else if (report_.samples > 1) {
      const KnobResult& first = report_.knobs.front();
      const LevelResult& any = first.levels[0] ? *first.levels[0] : *first.levels[1];
      document_.blocks.emplace_back(Paragraph{fmt::format(
          "Effects are medians of the differences seed by seed, intervals are those of the sign "
          "test, {:.1f} %. Unclear: the interval has both signs.",
          100 * of(any.effects, options_.by).confidence)});
    }
  }

  const Report& report_;
  const Description& description_;
  const Options& options_;
  Document document_;
};

}  // namespace

namespace {

/// Whether a user of the library can set it. The paper's model is nobody's: there it is everything
/// but the size of what is sent.
bool is_settable(std::string_view key, const model::DdsProfile& dds) {
  constexpr std::string_view prefix = "dds.";
  if (!key.starts_with(prefix)) return false;
  key.remove_prefix(prefix.size());
  const auto& whose = model::traits_of(dds).vendor;
  if (!whose) return key.starts_with("s") && !key.ends_with("_bytes");
  const auto knobs = vendor::vendor_knobs(
      *whose == model::vendor::cyclonedds ? vendor::Vendor::cyclonedds : vendor::Vendor::fastdds);
  const auto found = std::ranges::find(knobs, key, &vendor::VendorKnob::key);
  return found != knobs.end() && found->maximum > 0;
}

}  // namespace

std::optional<std::string> best_change(const Report& report, Measure by,
                                       const model::DdsProfile& dds) {
  std::optional<std::string> best;
  double least = 0;
  for (const KnobResult& knob : report.knobs) {
    if (!is_settable(knob.key, dds)) continue;
    for (const auto& level : knob.levels) {
      if (!level || of(level->effects, by).median >= least) continue;
      least = of(level->effects, by).median;
      best = knob.key + "=" + level->value;
    }
  }
  return best;
}

Document document_of(const Report& report, const Description& description) {
  return Builder{report, description}.build();
}

}  // namespace stormproof::sensitivity
