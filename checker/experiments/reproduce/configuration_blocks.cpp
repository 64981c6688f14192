// Grids over N_P and N_E, and tables with one row for each configuration.
#include "checker/experiments/reproduce/configuration_blocks.hpp"

#include <fmt/core.h>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/plot_style.hpp"

namespace stormproof::reproduce {

namespace {

using report::Column;
using report::Section;
using report::Table;

constexpr auto number_cells = Column::Align::right;

template <class Value>
Section grid(const Report& report, std::string title, Value value) {
  std::set<std::uint32_t> columns;
  for (const Configuration& one : report.results.plan.configurations) {
    columns.insert(one.endpoints_per_participant);
  }
  Table table{{{"N_P\\N_E"}}, {}};
  table.wide = true;
  for (const std::uint32_t ne : columns)
    table.columns.push_back({std::to_string(ne), number_cells});
  for (const std::uint32_t np : participant_counts(report.results.plan)) {
    Table::Row row{{std::to_string(np)}};
    for (const std::uint32_t ne : columns) row.cells.emplace_back(number_text(value({np, ne})));
    table.rows.push_back(std::move(row));
  }
  return {std::move(title), "", {std::move(table)}};
}

void add_grids(report::Blocks& blocks, const Report& report) {
  const Results& results = report.results;
  const Measures measures{results};
  const std::string& id = results.plan.variants.front().id;
  const auto add = [&](const char* title, auto value) {
    blocks.emplace_back(grid(report, fmt::format("{}, {}", title, id), value),
                        report::Audience::terminal);
  };
  add("Completion on Wi-Fi in s", [&](const Configuration& one) {
    const Outcome* outcome = results.find(0, Network::wireless, one);
    return outcome ? outcome->completion_s() : std::nullopt;
  });
  add("Total messages on Wi-Fi", [&](const Configuration& one) {
    const Outcome* outcome = results.find(0, Network::wireless, one);
    return outcome ? outcome->messages(Class::total) : std::nullopt;
  });
  add("Total messages, Wi-Fi / wired",
      [&](const Configuration& one) { return measures.wireless_to_wired(0, one); });
}

/// All configurations of one variant on Wi-Fi.
Section configuration_table(const Report& report, std::size_t variant) {
  const Measures measures{report.results};
  Table table;
  const auto column = [&table](std::string head) {
    table.columns.push_back({std::move(head), number_cells});
  };
  for (const char* head : {"N_P", "N_E", "completion s", "open loop s"}) column(head);
  for (const Class what : table_classes) column(name_of(what));
  for (const char* head : {"failure-free", "Wi-Fi / wired", "adaptive s", "completed"}) {
    column(head);
  }
  for (const Configuration& one : report.results.plan.configurations) {
    const Outcome* outcome = report.results.find(variant, Network::wireless, one);
    if (outcome == nullptr) continue;
    const Outcome* adaptive = report.results.find(
        {variant, Network::wireless, model::HeartbeatPolicy::adaptive, orders[0], one});
    Table::Row row{
        {std::to_string(one.participants_per_host), std::to_string(one.endpoints_per_participant),
         number_text(outcome->completion_s()), number_text(measures.open_loop_s(variant, one))}};
    for (const Class what : table_classes) {
      row.cells.emplace_back(number_text(outcome->messages(what)));
    }
    row.cells.emplace_back(number_text(measures.reference_messages(variant, Class::total, one)));
    row.cells.emplace_back(number_text(measures.wireless_to_wired(variant, one)));
    row.cells.emplace_back(number_text(adaptive ? adaptive->completion_s() : std::nullopt));
    row.cells.emplace_back(fmt::format("{} of {}", outcome->completed(), outcome->runs.size()));
    table.rows.push_back(std::move(row));
  }
  return {"All configurations, " + report.results.plan.variants[variant].id,
          "",
          {std::move(table)},
          true};
}

}  // namespace

void add_configurations(report::Blocks& blocks, const Report& report) {
  const std::size_t variants = report.results.plan.variants.size();
  if (variants == 0) return;
  add_grids(blocks, report);
  Section all{"Configurations", "configurations"};
  for (std::size_t v = 0; v < variants; ++v)
    all.blocks.emplace_back(configuration_table(report, v));
  blocks.emplace_back(std::move(all), report::Audience::documents);
}

}  // namespace stormproof::reproduce
