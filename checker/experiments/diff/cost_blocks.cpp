// The costs of a comparison as blocks: a row for each configuration, all measures of the worst,
// median and best, limits, what was decided together, and plots.
#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "checker/experiments/diff/diff_parts.hpp"
#include "checker/experiments/diff/diff_plots.hpp"
#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::diff {

namespace {

using report::Audience;
using report::Blocks;
using report::Column;
using report::Paragraph;
using report::Section;
using report::Table;

using Order = std::vector<const Configuration*>;

constexpr std::size_t longest_bar = 24;  // of a chart beside other columns
constexpr auto to_right = Column::Align::right;

/// "6, 30": the values alone, as the heading has the keys.
std::string values_text(const Configuration& configuration) {
  if (configuration.values.empty()) return configuration.name;
  std::string text;
  for (const auto& [key, value] : configuration.values) text += (text.empty() ? "" : ", ") + value;
  return text;
}

std::string keys_text(const Configuration& configuration) {
  std::string text;
  for (const auto& [key, value] : configuration.values) {
    text += (text.empty() ? "" : ", ") + key.substr(key.rfind('.') + 1);
  }
  return text;
}

std::string both_text(const MeasuredChange& change) {
  return fmt::format("{} → {}, {}", median_text(change, change.before.median),
                     median_text(change, change.after.median), change_text(change));
}

/// By how much the completion changes; those that never complete are the worst.
double rank_of(const Configuration& configuration) {
  const MeasuredChange& completion = configuration[Measure::completion];
  constexpr double above_all = std::numeric_limits<double>::infinity();
  if (!completion.after.median) return completion.before.median ? above_all : 0;
  if (!completion.before.median) return -1;
  return *completion.after.median / std::max(*completion.before.median, 1.0) - 1;
}

/// Those of [from, to) as rows; pages have more columns.
Table table_of(const Order& order, std::size_t from, std::size_t to, const Policy& policy) {
  const auto of_documents = [](const char* head, Column::Align align = Column::Align::left) {
    return Column{head, align, align == Column::Align::left, Audience::documents};
  };
  Table table{{{"configuration"},
               {"judgment"},
               {"completion", to_right},
               {"after", to_right},
               {"change"},
               {"messages"},
               of_documents("runs", to_right),
               of_documents("repairs"),
               of_documents("highest backlog"),
               of_documents("storms")},
              {}};
  table.caption = keys_text(*order.front());
  for (std::size_t k = from; k < to; ++k) {
    const Configuration& one = *order[k];
    const MeasuredChange& completion = one[Measure::completion];
    table.rows.push_back({{values_text(one), badge_of(judgment_of(one, policy)),
                           median_text(completion, completion.before.median),
                           median_text(completion, completion.after.median),
                           one.identical_runs ? "the same runs" : change_text(completion),
                           one.identical_runs ? "" : change_text(one[Measure::messages]),
                           report::grouped(one.samples), both_text(one[Measure::repair_data]),
                           both_text(one[Measure::backlog]),
                           fmt::format("{} → {}", one.storm_before ? "yes" : "no",
                                       one.storm_after ? "yes" : "no")}});
  }
  return table;
}

void add_rows(Blocks& blocks, const DiffReport& report) {
  const Order order = in_shown_order(report);
  const std::size_t shown = std::min(order.size(), configurations_shown);
  blocks.emplace_back(table_of(order, 0, shown, report.policy));
  if (shown == order.size()) return;
  blocks.emplace_back(
      Paragraph{fmt::format("and {} less bad ones; -v shows all", order.size() - shown)},
      Audience::terminal);
  blocks.emplace_back(table_of(order, shown, order.size(), report.policy), Audience::verbose);
}

/// All measures of one configuration.
Table details_of(const char* which, const Configuration& configuration) {
  Table table{{{""}, {"before", to_right}, {"after", to_right}, {"change"}, {""}},
              {},
              fmt::format("{}{}: {} deliveries of descriptors, {} of each profile", which,
                          configuration.name, report::grouped(configuration.descriptors),
                          plural(configuration.samples, "run"))};
  for (const MeasuredChange& change : configuration.measures) {
    const bool silent = change.before.max == 0.0 && change.after.max == 0.0;
    if (silent) continue;
    table.rows.push_back(
        {{words_of(change.measure), median_text(change, change.before.median),
          median_text(change, change.after.median), change_text(change),
          change.judgment == Judgment::same ? report::Text{} : badge_of(change.judgment)}});
  }
  return table;
}

void add_details(Blocks& blocks, const CostComparison& costs) {
  Order order;
  for (const Configuration& configuration : costs.configurations) {
    if (!configuration.identical_runs) order.push_back(&configuration);
  }
  if (order.empty()) return;
  std::ranges::stable_sort(order, std::greater{},
                           [](const Configuration* each) { return rank_of(*each); });
  const std::size_t middle = order.size() / 2;
  Section others{"All measures of the other configurations", "", {}, true};
  for (std::size_t k = 0; k < order.size(); ++k) {
    const char* which = order.size() == 1       ? ""
                        : k == 0                ? "slowed most: "
                        : k == order.size() - 1 ? "slowed least: "
                        : k == middle           ? "median: "
                                                : nullptr;
    if (which != nullptr) {
      blocks.emplace_back(details_of(which, *order[k]));
    } else {
      others.blocks.emplace_back(details_of("", *order[k]));
    }
  }
  if (!others.blocks.empty()) blocks.emplace_back(std::move(others), Audience::verbose);
}

void add_crossings(Blocks& blocks, const CostComparison& costs) {
  Table table{{{"judgment"},
               {"limit"},
               {"configuration", Column::Align::left, true},
               {"exceeded before", to_right},
               {"after", to_right}},
              {}};
  for (const Configuration& one : costs.configurations) {
    for (const LimitCrossing& crossing : one.crossings) {
      table.rows.push_back({{badge_of(crossing.judgment), report::code(crossing.text), one.name,
                             share_text(crossing.before), share_text(crossing.after)}});
    }
  }
  if (table.rows.empty()) return;
  blocks.emplace_back(Section{
      "Limits that are crossed, and the share of runs that exceed them", "", {std::move(table)}});
}

void add_pooled(Blocks& blocks, const CostComparison& costs) {
  report::Bullets bullets;
  for (const PooledChange& pooled : costs.pooled) {
    bullets.items.emplace_back(fmt::format(
        "{} of {}: not settled by themselves; over their {} of runs the median change is {} ({} … "
        "{} at {}): {}",
        words_of(pooled.measure), plural(pooled.configurations, "configuration"),
        plural(pooled.pairs, "pair"), change_text(pooled.estimate), change_text(pooled.low),
        change_text(pooled.high), share_text(pooled.confidence), name_of(pooled.judgment)));
  }
  if (!bullets.items.empty()) blocks.emplace_back(std::move(bullets));
}

/// Completion over the load and the swept keys; messages by class where it is worth a look.
void add_plots(Blocks& blocks, const CostComparison& costs) {
  const auto add = [&blocks](std::string svg) {
    if (!svg.empty()) blocks.emplace_back(report::Drawing{std::move(svg), ""}, Audience::page);
  };
  for (std::string& svg : measure_plots(costs, Measure::completion)) add(std::move(svg));
  for (const Configuration* one : notable(costs)) add(classes_plot(*one));
  for (const Measure measure : {Measure::messages, Measure::backlog}) {
    std::vector<std::string> plots = measure_plots(costs, measure);
    if (!plots.empty()) add(std::move(plots.front()));
  }
}

std::string about(const DiffReport& report) {
  const CostComparison& costs = report.costs;
  const bool drawn = std::ranges::any_of(costs.configurations, [](const Configuration& each) {
    const std::optional<Shift>& shift = each[Measure::messages].shift;
    return shift && !shift->exact;
  });
  std::string text =
      fmt::format("{}: {} of {}, both profiles on the same schedules", costs.grid,
                  costs.configurations.size(), plural(costs.wanted, "configuration"));
  if (!drawn) return text + ".";
  return text + fmt::format(
                    " ({} of each at first, seed {}). Medians; intervals of the shift that all "
                    "hold together with {} confidence ({} each).",
                    costs.samples, costs.seed, share_text(report.policy.confidence),
                    share_text(costs.confidence));
}

}  // namespace

std::vector<const Configuration*> in_shown_order(const DiffReport& report) {
  Order order;
  for (const Configuration& each : report.costs.configurations) order.push_back(&each);
  if (order.size() > configurations_shown) {
    std::ranges::stable_sort(order, std::greater{}, [&report](const Configuration* each) {
      return std::pair{badness(judgment_of(*each, report.policy)), rank_of(*each)};
    });
  }
  return order;
}

void add_comment_chart(Blocks& blocks, const DiffReport& report) {
  const Order order = in_shown_order(report);
  if (order.empty()) return;
  const std::size_t shown = std::min(order.size(), configurations_shown);
  double longest = 0;
  for (std::size_t k = 0; k < shown; ++k) {
    const MeasuredChange& completion = (*order[k])[Measure::completion];
    longest = std::max(
        {longest, completion.before.median.value_or(0), completion.after.median.value_or(0)});
  }
  Table table{{{keys_text(*order.front())}, {""}, {"completion", to_right}, {""}}, {}};
  for (std::size_t k = 0; k < shown; ++k) {
    const MeasuredChange& completion = (*order[k])[Measure::completion];
    const auto add = [&](std::string name, const char* side, const std::optional<double>& median) {
      const double share = median && longest > 0 ? *median / longest : 0;
      table.rows.push_back({{std::move(name), side, median_text(Measure::completion, median),
                             report::bar(share, longest_bar)}});
    };
    add(values_text(*order[k]), "base", completion.before.median);
    add("", "candidate", completion.after.median);
  }
  blocks.emplace_back(Section{"Completion", "", {std::move(table)}}, Audience::comment);
}

void add_costs(Blocks& blocks, const DiffReport& report) {
  const CostComparison& costs = report.costs;
  if (costs.wanted == 0) return;
  Section section{"Costs", "costs"};
  section.folded_in_comments = true;
  if (costs.configurations.empty()) {
    section.blocks.emplace_back(Paragraph{"No configuration was finished."});
  } else {
    section.blocks.emplace_back(Paragraph{about(report)});
    add_plots(section.blocks, costs);
    add_rows(section.blocks, report);
    add_pooled(section.blocks, costs);
    add_details(section.blocks, costs);
    add_crossings(section.blocks, costs);
  }
  blocks.emplace_back(std::move(section));
}

}  // namespace stormproof::diff
