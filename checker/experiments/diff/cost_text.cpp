// Rows, details of the worst, median and best configuration, limits, and what was decided together.
#include "checker/experiments/diff/cost_text.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::diff {

namespace {

using report::left;
using report::paragraph;
using report::right;

constexpr std::size_t name_columns = 14;
constexpr std::size_t value_columns = 10;
constexpr std::size_t change_columns = 27;
constexpr std::size_t rows_shown = 16;

/// "6, 30": the values alone, as the heading has the keys.
std::string values_text(const Configuration& configuration) {
  std::string text;
  for (const auto& [key, value] : configuration.values) text += (text.empty() ? "" : ", ") + value;
  return text;
}

std::string median_text(const MeasuredChange& change, const std::optional<double>& median) {
  if (median) return value_text(change.measure, *median);
  return change.measure == Measure::completion ? "never" : "–";
}

std::string row_text(const Configuration& configuration, const Policy& policy) {
  const std::string values = values_text(configuration);
  const bool is_long = report::columns(values) > name_columns;
  std::string text = is_long ? "  " + values + "\n" : "";
  const MeasuredChange& completion = configuration[Measure::completion];
  text += "  " + left(is_long ? "" : values, name_columns + 1) +
          left(name_of(judgment_of(configuration, policy)), 11) +
          right(median_text(completion, completion.before.median), value_columns) +
          right(median_text(completion, completion.after.median), value_columns);
  const std::string change = configuration.identical_runs ? "the same runs"
                             : completion.shift           ? change_text(completion)
                                                          : "–";
  text += "  " + left(change, change_columns);
  if (!configuration.identical_runs) text += change_text(configuration[Measure::messages]);
  while (text.ends_with(' ')) text.pop_back();
  return text + "\n";
}

/// By how much the completion changes; those that never complete are the worst.
double rank_of(const Configuration& configuration) {
  const MeasuredChange& completion = configuration[Measure::completion];
  constexpr double above_all = std::numeric_limits<double>::infinity();
  if (!completion.after.median) return completion.before.median ? above_all : 0;
  if (!completion.before.median) return -1;
  return *completion.after.median / std::max(*completion.before.median, 1.0) - 1;
}

std::string details_text(const char* which, const Configuration& configuration) {
  std::string text = "\n" + paragraph("  ", fmt::format("{}{}: {} deliveries of descriptors, {} of "
                                                        "each profile",
                                                        which, configuration.name,
                                                        report::grouped(configuration.descriptors),
                                                        plural(configuration.samples, "run")));
  for (const MeasuredChange& change : configuration.measures) {
    const bool silent = change.before.max == 0.0 && change.after.max == 0.0;
    if (silent) continue;
    std::string line = "    " + left(words_of(change.measure), 17) +
                       right(median_text(change, change.before.median), 11) +
                       right(median_text(change, change.after.median), 11) + "  " +
                       left(change_text(change), change_columns + 2) +
                       (change.judgment == Judgment::same ? "" : name_of(change.judgment));
    while (line.ends_with(' ')) line.pop_back();
    text += line + "\n";
  }
  return text;
}

std::string crossings_text(const CostComparison& costs) {
  std::string text;
  for (const Configuration& configuration : costs.configurations) {
    for (const LimitCrossing& crossing : configuration.crossings) {
      text += paragraph(
          "  " + left(name_of(crossing.judgment), 12),
          fmt::format("{} at {}: exceeded by {} of the runs before, by {} after", crossing.text,
                      configuration.name, share_text(crossing.before), share_text(crossing.after)));
    }
  }
  return text.empty() ? "" : "\nlimits that are crossed\n" + text;
}

std::string pooled_text(const CostComparison& costs) {
  std::string text;
  for (const PooledChange& pooled : costs.pooled) {
    text += paragraph(
        "  ",
        fmt::format("{} of {}: not settled by themselves; over their {} the median change is {} "
                    "({} … {}): {}",
                    words_of(pooled.measure), plural(pooled.configurations, "configuration"),
                    plural(pooled.pairs, "pair") + " of runs", change_text(pooled.estimate),
                    change_text(pooled.low), change_text(pooled.high), name_of(pooled.judgment)));
  }
  return text;
}

std::string table_text(const CostComparison& costs, const Policy& policy, bool verbose) {
  std::string keys;
  for (const auto& [key, value] : costs.configurations.front().values) {
    keys += (keys.empty() ? "" : ", ") + key.substr(key.rfind('.') + 1);
  }
  std::string text = keys.empty() ? "" : "  " + keys + ":\n";
  text += "  " + left("", name_columns + 1) + left("", 11) + right("completion", value_columns) +
          right("after", value_columns) + "  " + left("change", change_columns) + "messages\n";
  const std::size_t shown =
      verbose ? costs.configurations.size() : std::min(costs.configurations.size(), rows_shown);
  std::vector<const Configuration*> order;
  for (const Configuration& configuration : costs.configurations) order.push_back(&configuration);
  if (shown < order.size()) {
    const auto rank = [&policy](const Configuration* each) {
      return std::pair{badness(judgment_of(*each, policy)), rank_of(*each)};
    };
    std::ranges::stable_sort(order, [&rank](const Configuration* a, const Configuration* b) {
      return rank(a) > rank(b);
    });
  }
  for (std::size_t k = 0; k < shown; ++k) text += row_text(*order[k], policy);
  if (shown < order.size()) {
    text += fmt::format("  and {} less bad ones; -v shows all\n", order.size() - shown);
  }
  return text;
}

}  // namespace

std::string costs_text(const DiffReport& report, bool verbose) {
  const CostComparison& costs = report.costs;
  if (costs.wanted == 0) return "";
  std::string text = "\ncosts\n";
  if (costs.configurations.empty()) return text + "  no configuration was finished\n";
  const bool drawn = std::ranges::any_of(costs.configurations, [](const Configuration& each) {
    const std::optional<Shift>& shift = each[Measure::messages].shift;
    return shift && !shift->exact;
  });
  std::string about =
      fmt::format("{}: {} of {}, both profiles on the same schedules", costs.grid,
                  costs.configurations.size(), plural(costs.wanted, "configuration"));
  if (drawn) {
    about += fmt::format(
        " ({} of each at first, seed {}). Medians; intervals of the shift that "
        "all hold together with {} confidence",
        costs.samples, costs.seed, share_text(report.policy.confidence));
  }
  text +=
      paragraph("  ", about + ".") + table_text(costs, report.policy, verbose) + pooled_text(costs);
  std::vector<const Configuration*> order;
  for (const Configuration& configuration : costs.configurations) {
    if (!configuration.identical_runs) order.push_back(&configuration);
  }
  std::ranges::stable_sort(order, [](const Configuration* a, const Configuration* b) {
    return rank_of(*a) > rank_of(*b);
  });
  if (verbose) {
    for (const Configuration* each : order) text += details_text("", *each);
  } else if (!order.empty()) {
    text += details_text(order.size() > 1 ? "slowed most: " : "", *order.front());
    if (order.size() > 2) text += details_text("median: ", *order[order.size() / 2]);
    if (order.size() > 1) text += details_text("slowed least: ", *order.back());
  }
  return text + crossings_text(costs);
}

}  // namespace stormproof::diff
