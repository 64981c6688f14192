// Two sequence charts on one sheet, without what both runs begin with.
#include "checker/experiments/diff/paired_charts.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "checker/presentation/diagrams/svg_sheet.hpp"
#include "checker/presentation/text/time_text.hpp"
#include "checker/verification/counterexample/chart.hpp"

namespace stormproof::diff {

namespace {

/// What both runs begin with is one line in both, but for the last rows before they part.
void fold_common_start(counterexample::Chart& base, counterexample::Chart& candidate) {
  constexpr std::size_t kept = 3;
  const std::size_t common = sequence::common_rows(base, candidate);
  if (common < kept + 2) return;
  const counterexample::Chart::Row& last = base.rows[common - kept - 1];
  const std::string text = fmt::format("both runs do the same up to event {} at {} ms", last.event,
                                       report::milliseconds(last.time));
  for (counterexample::Chart* chart : {&base, &candidate}) {
    sequence::fold_start(*chart, common - kept, text);
  }
}

draw::SvgParts drawn(counterexample::Chart chart, std::string_view side, std::string_view name) {
  chart.title = name.empty() ? std::string{side} : fmt::format("{}: {}", side, name);
  chart.closing = "Here the runs part";
  chart.sign = "≠";
  return draw::take_apart(counterexample::svg_chart(chart));
}

}  // namespace

std::string paired_charts_svg(const TellingApart& apart, std::string_view base_name,
                              std::string_view candidate_name) {
  if (!apart.found) return {};
  counterexample::Chart base = counterexample::chart_of(apart.base_run, apart.base_packets);
  counterexample::Chart candidate =
      counterexample::chart_of(apart.candidate_run, apart.candidate_packets);
  fold_common_start(base, candidate);
  const draw::SvgParts above = drawn(std::move(base), "Base", base_name);
  const draw::SvgParts below = drawn(std::move(candidate), "Candidate", candidate_name);
  const std::string border =
      fmt::format("  <line x1=\"0\" y1=\"{1}\" x2=\"{0}\" y2=\"{1}\" class=\"lane\"/>\n",
                  std::max(above.width, below.width), above.height);
  return draw::svg_sheet("The least scenario that tells the profiles apart", apart.difference,
                         {{above, 0, 0}, {below, 0, above.height}}, border);
}

}  // namespace stormproof::diff
