// A rolling upgrade as blocks: the worst and the best order of its hosts, with what each fleet on
// the way costs.
#include <algorithm>

#include <fmt/format.h>

#include "checker/experiments/diff/diff_parts.hpp"
#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/words.hpp"

namespace stormproof::diff {

namespace {

using report::Column;
using report::Paragraph;
using report::Section;
using report::Table;

constexpr auto to_right = Column::Align::right;

const Configuration& configuration_of(const CostComparison& costs, const RolloutStep& step) {
  return *std::ranges::find(costs.configurations, step.configuration, &Configuration::name);
}

Table table_of(const std::vector<RolloutStep>& order, const DiffReport& report,
               const std::string& caption) {
  Table table{{{"upgraded"},
               {"completion", to_right},
               {"change"},
               {"messages", to_right},
               {"storm"},
               {"judgment"}},
              {},
              caption};
  const Configuration& first = configuration_of(report.costs, order.front());
  table.rows.push_back(
      {{"nobody", median_text(Measure::completion, first[Measure::completion].before.median), "",
        value_text(Measure::messages, first[Measure::messages].before.median),
        first.storm_before ? "yes" : "no", ""}});
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Configuration& one = configuration_of(report.costs, order[k]);
    const bool is_last = k + 1 == order.size();
    table.rows.push_back(
        {{fmt::format("{}host {}{}", k == 0 ? "" : "+ ", order[k].host,
                      is_last ? ", the last" : ""),
          median_text(Measure::completion, one[Measure::completion].after.median),
          change_text(one[Measure::completion]),
          value_text(Measure::messages, one[Measure::messages].after.median),
          one.storm_after ? "yes" : "no", badge_of(judgment_of(one, report.policy))}});
  }
  return table;
}

}  // namespace

void add_rollouts(report::Blocks& blocks, const DiffReport& report) {
  if (report.rollouts.empty()) return;
  Section section{"Rolling upgrade", "rolling"};
  for (const Rollout& one : report.rollouts) {
    const bool is_one = one.kinds == 1;
    section.blocks.emplace_back(Paragraph{fmt::format(
        "{}: {} with at least one upgraded host, medians. {}", one.fleet,
        plural(one.fleets, "fleet"),
        is_one ? "All hosts are alike, so it does not matter which goes first."
               : fmt::format("Its hosts are of {}; those of one kind are taken as interchangeable, "
                             "the lowest first. An order is as bad as the worst fleet that it "
                             "passes through.",
                             plural(one.kinds, "kind")))});
    section.blocks.emplace_back(
        table_of(one.worst, report, is_one ? "host by host" : "worst order"));
    if (!is_one) section.blocks.emplace_back(table_of(one.best, report, "best order"));
  }
  blocks.emplace_back(std::move(section));
}

}  // namespace stormproof::diff
