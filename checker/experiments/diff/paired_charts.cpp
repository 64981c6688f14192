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

using sequence::Chart;

Chart titled_chart(const props::Counterexample& run, const std::vector<std::uint64_t>& packets,
                   std::string_view side, std::string_view name) {
  Chart chart = counterexample::chart_of(run, packets);
  chart.title = name.empty() ? std::string{side} : fmt::format("{}: {}", side, name);
  chart.closing = "Here the runs part";
  chart.sign = "≠";
  return chart;
}

/// What both runs begin with becomes one line, but for the last rows before they part.
void fold_common_start(PairedCharts& charts, CommonStart start) {
  constexpr std::size_t kept = 3;
  const std::size_t common = sequence::common_rows(charts.base, charts.candidate);
  if (common < kept + 2) return;
  const Chart::Row& last = charts.base.rows[common - kept - 1];
  const std::string text = fmt::format("both runs do the same up to event {} at {} ms", last.event,
                                       report::milliseconds(last.time));
  sequence::fold_start(charts.candidate, common - kept, text);
  if (start == CommonStart::nowhere) sequence::fold_start(charts.base, common - kept, text);
}

}  // namespace

PairedCharts paired_charts(const TellingApart& apart, std::string_view base_name,
                           std::string_view candidate_name, CommonStart start) {
  PairedCharts charts{
      titled_chart(apart.base_run, apart.base_packets, "Base", base_name),
      titled_chart(apart.candidate_run, apart.candidate_packets, "Candidate", candidate_name)};
  sequence::share_lanes(charts.base, charts.candidate);
  fold_common_start(charts, start);
  return charts;
}

std::string paired_charts_svg(const TellingApart& apart, std::string_view base_name,
                              std::string_view candidate_name) {
  if (!apart.found) return {};
  const PairedCharts charts = paired_charts(apart, base_name, candidate_name, CommonStart::nowhere);
  const draw::SvgParts above = draw::take_apart(sequence::svg_chart(charts.base));
  const draw::SvgParts below = draw::take_apart(sequence::svg_chart(charts.candidate));
  const std::string border =
      fmt::format("  <line x1=\"0\" y1=\"{1}\" x2=\"{0}\" y2=\"{1}\" class=\"lane\"/>\n",
                  std::max(above.width, below.width), above.height);
  return draw::svg_sheet("The least scenario that tells the profiles apart", apart.difference,
                         {{above, 0, 0}, {below, 0, above.height}}, border);
}

}  // namespace stormproof::diff
