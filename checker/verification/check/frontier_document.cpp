// One row for each kind of load.
#include "checker/verification/check/frontier_document.hpp"

#include <fmt/core.h>

#include "props/monitors/describe.hpp"

namespace stormproof::checker {

namespace {

std::string most_text(const calculus::Frontier& frontier) {
  if (!frontier.most) return fmt::format("not even {}", frontier.least);
  if (*frontier.most == frontier.limit) return fmt::format("{} or more", frontier.limit);
  return fmt::format("{}", *frontier.most);
}

}  // namespace

void add_frontiers(report::Document& document, const calculus::Frontiers& frontiers) {
  report::Section section{"The largest load that cannot start a storm", "frontier"};
  if (!frontiers.why_not.empty()) {
    section.blocks.emplace_back(report::Paragraph{
        fmt::format("storm.cannot-start does not apply: {}.", frontiers.why_not)});
    document.blocks.emplace_back(std::move(section));
    return;
  }
  using Align = report::Column::Align;
  report::Table table{{{"load"},
                       {"now", Align::right},
                       {"storm.cannot-start is proved up to", Align::right},
                       {"no packet then takes longer than", Align::right}},
                      {}};
  for (const calculus::Frontier& one : frontiers.of_loads) {
    table.rows.push_back({{one.load, one.now ? fmt::format("{}", *one.now) : "various",
                           most_text(one), one.delay ? props::time_text(*one.delay) : "–"}});
  }
  section.blocks.emplace_back(report::Paragraph{
      "Each kind of load alone, the rest as it is; whatever the start times are."});
  if (!frontiers.why_not_provable.empty()) {
    section.blocks.emplace_back(report::Paragraph{fmt::format(
        "Of the deployment as it is nothing is proved: {}.", frontiers.why_not_provable)});
  }
  section.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(std::move(section));
}

}  // namespace stormproof::checker
