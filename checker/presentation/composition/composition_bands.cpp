// Every line of a rule has a place of its own; what leaves stands beside the effect that sends it.
#include "checker/presentation/composition/composition_bands.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::draw {

namespace {

namespace comp = fsm::composition;

// From left to right: causes, the band with numbers and code, and in it what leaves.
constexpr int causes_left = CompositionPen::page_left;
constexpr int causes_width = 176;
constexpr int band_left = causes_left + causes_width + 20;
constexpr int code_left = band_left + 44;
constexpr int out_left = 752;
constexpr int band_right = CompositionPen::page_right;
constexpr int indent_width = 16;
constexpr int band_head = 34;  ///< from its top to its first row

class Band {
 public:
  Band(const comp::CompositionInfo& composition, const std::vector<Party>& parties,
       const comp::RuleInfo& rule, CompositionPen& pen, Svg& svg)
      : composition_{composition}, parties_{parties}, rule_{rule}, pen_{pen}, svg_{svg} {}

  int draw(int top) {
    svg_.open_group(CompositionPen::element_id(rule_.id), "told");
    const int causes_bottom = draw_causes(top);
    const std::vector<Row> rows = rows_from(top + band_head);
    const int bottom = std::max(causes_bottom, rows_bottom(rows, top));
    const bool procedure = is_in(composition_.procedures);
    svg_.rect(band_left, top, band_right - band_left, bottom - top,
              !rule_.trigger.empty() ? "outline rule"
              : procedure            ? "outline procedure"
                                     : "outline step",
              6);
    svg_.text(band_left + 12, top + 21, rule_.id, "bold");
    svg_.text(band_right - 12, top + 21, whose(), "quiet small", Anchor::end);
    if (rows.empty()) svg_.text(code_left, top + 46, "nothing between machines", "quiet");
    draw_brackets(rows);
    for (const Row& row : rows) draw(row);
    svg_.close_group();
    return bottom;
  }

  /// Where it begins. Short ones stand on one page, long ones begin with more than their name.
  [[nodiscard]] int place(int y) {
    const int causes = draw_causes(0);
    const int height = std::max(causes, rows_bottom(rows_from(band_head), 0));
    constexpr int short_enough = 240;
    const bool whole = height <= short_enough;
    return CompositionPen::on_one_page(y, whole ? height : std::max(causes, short_enough / 2));
  }

 private:
  struct Row {
    ProgramLine line;
    std::vector<std::string> texts;
    int top = 0;
    int bottom = 0;
  };

  [[nodiscard]] bool is_in(const std::vector<comp::RuleInfo>& rules) const {
    return std::ranges::find(rules, rule_.id, &comp::RuleInfo::id) != rules.end();
  }

  /// "of each relation, writer side".
  [[nodiscard]] std::string whose() const {
    const Party* party = party_of(parties_, rule_.id);
    const std::string side = party == nullptr ? "any side" : party->name;
    if (!rule_.trigger.empty()) return fmt::format("of each {}; {}", rule_.owner, side);
    return (is_in(composition_.procedures) ? "procedure, " : "step, what it may do; ") + side;
  }

  /// The trigger at the left, and who causes it; returns where it ends.
  int draw_causes(int top) {
    const int x = causes_left;
    if (rule_.trigger.empty()) {
      const bool step = is_in(composition_.steps);
      return pen_.links(x, top + 20, causes_width, step ? "performed by" : "called by",
                        callers_of(composition_, rule_.id));
    }
    const int width = pen_.chip(x, top + 7, rule_.cause);
    svg_.line(x + width + 2, top + 16, band_left - 2, top + 16, "way into");
    svg_.text(x, top + 40, verb(rule_), "small");
    const auto [how, causes] = caused_by();
    return pen_.links(x, top + 54, causes_width, how, causes);
  }

  [[nodiscard]] std::pair<std::string_view, std::vector<std::string>> caused_by() const {
    if (rule_.trigger == "happens") {
      const auto raisers = causes_of(composition_, rule_.cause, {"raise"});
      return {raisers.empty() ? "from outside" : "raised by", raisers};
    }
    if (rule_.trigger == "due") {
      return {"started by", causes_of(composition_, rule_.cause, {"after", "at"})};
    }
    return {"sent by", causes_of(composition_, rule_.cause, {"emit"})};
  }

  /// The program with the place of each line.
  [[nodiscard]] std::vector<Row> rows_from(int y) const {
    std::vector<Row> rows;
    for (ProgramLine& line : program(rule_)) {
      Row row{std::move(line), {}, 0, 0};
      const int indent = indent_width * static_cast<int>(row.line.depth);
      row.texts = report::wrapped(row.line.text,
                                  CompositionPen::columns(out_left - 16 - code_left - indent), 4);
      int height = height_of(row.texts);
      if (row.line.effect != nullptr) height = std::max(height, out_height(*row.line.effect));
      row.top = CompositionPen::on_one_page(y, height);
      row.bottom = y = row.top + height;
      rows.push_back(std::move(row));
    }
    return rows;
  }
  /// Of a band from `top` on; one without rows says so.
  static int rows_bottom(const std::vector<Row>& rows, int top) {
    return rows.empty() ? top + 54 : rows.back().bottom + 8;
  }
  static int height_of(const std::vector<std::string>& lines) {
    return CompositionPen::line_height * static_cast<int>(lines.size());
  }

  static int text_bottom(const Row& row) { return row.top + height_of(row.texts); }

  [[nodiscard]] static bool has_chip(const comp::EffectInfo& effect) {
    return effect.kind == "emit" || effect.kind == "after" || effect.kind == "at" ||
           effect.kind == "cancel" || effect.kind == "raise";
  }
  [[nodiscard]] static bool leads(const comp::EffectInfo& effect) {
    return has_chip(effect) || effect.kind == "call" || effect.kind == "perform";
  }
  [[nodiscard]] int out_height(const comp::EffectInfo& effect) const {
    if (!leads(effect)) return 0;
    Svg scratch{"", ""};
    CompositionPen measuring{composition_, scratch};
    return Band{composition_, parties_, rule_, measuring, scratch}.draw_out(effect, 0) + 2;
  }

  /// What leaves: a chip with the rules that it leads to, beside it if there is room, or a link.
  /// Returns where it ends.
  int draw_out(const comp::EffectInfo& effect, int top) {
    constexpr int room = band_right - 12 - out_left;
    constexpr int below_baseline = 4 - CompositionPen::small_line;
    const auto names = led_to(composition_, effect);
    if (!has_chip(effect)) {
      return pen_.links(out_left, top + 12, room, "→", names) + below_baseline;
    }
    const int width = pen_.chip(out_left, top - 1, effect.target);
    if (effect.kind == "cancel") {
      svg_.line(out_left - 3, top + 8, out_left + width + 3, top + 8, "way");
    }
    if (names.empty()) return top + CompositionPen::chip_height;
    const auto all = fmt::format("→ {}", fmt::join(names, ", "));
    if (text_width(all, CompositionPen::small_size) <= room - width - 8) {
      pen_.links(out_left + width + 8, top + 12, room, "→", names);
      return top + CompositionPen::chip_height;
    }
    return pen_.links(out_left + 8, top + 29, room - 8, "→", names) + below_baseline;
  }

  void draw_brackets(const std::vector<Row>& rows) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (rows[k].line.effect != nullptr) continue;
      std::size_t last = k;
      while (last + 1 < rows.size() && rows[last + 1].line.depth > rows[k].line.depth) ++last;
      const int x = code_left + indent_width * static_cast<int>(rows[k].line.depth) + 3;
      svg_.path(fmt::format("M{} {} V{} h5", x, text_bottom(rows[k]), text_bottom(rows[last]) - 4),
                "bracket");
    }
  }

  void draw(const Row& row) {
    const comp::EffectInfo* effect = row.line.effect;
    const int x = code_left + indent_width * static_cast<int>(row.line.depth);
    if (effect == nullptr) {
      pen_.lines(x, row.top + 12, row.texts, "condition");
      return;
    }
    svg_.open_group(CompositionPen::element_id(effect->id), "told");
    svg_.text(band_left + 12, row.top + 12, number_of(*effect), "quiet small");
    pen_.lines(x, row.top + 12, row.texts, effect->kind.starts_with("feed") ? "machine" : "");
    if (leads(*effect)) {
      const int end = x + text_width(row.texts.front(), CompositionPen::font_size) + 6;
      if (end < out_left - 6) svg_.line(end, row.top + 8, out_left - 6, row.top + 8, "hint");
      draw_out(*effect, row.top);
    }
    svg_.close_group();
  }

  const comp::CompositionInfo& composition_;
  const std::vector<Party>& parties_;
  const comp::RuleInfo& rule_;
  CompositionPen& pen_;
  Svg& svg_;
};

}  // namespace

int draw_band(const comp::CompositionInfo& composition, const std::vector<Party>& parties,
              const comp::RuleInfo& rule, CompositionPen& pen, Svg& svg, int y) {
  Svg scratch{"", ""};
  CompositionPen measuring{composition, scratch};
  const int top = Band{composition, parties, rule, measuring, scratch}.place(y);
  return Band{composition, parties, rule, pen, svg}.draw(top);
}

std::string band_style() {
  return R"(
    .rule { fill: var(--panel); stroke: var(--quiet); }
    .procedure { fill: var(--paper); stroke: var(--quiet); }
    .step { fill: var(--paper); stroke: var(--quiet); stroke-dasharray: 5 3; }
    .told:target .outline { stroke: var(--packet); stroke-width: 3; }
    .told:target text { font-weight: 600; }
    .bracket { fill: none; stroke: var(--rule); stroke-width: 1.5; }
    .hint { stroke: var(--rule); stroke-dasharray: 1 3; }
    .condition { fill: var(--timer); }
)";
}

}  // namespace stormproof::draw
