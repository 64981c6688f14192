// Turns configurations into series.
#include "checker/experiments/diff/diff_plots.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/charts/plot.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::diff {

namespace {

using Configurations = std::vector<const Configuration*>;
using Position = std::function<double(const Configuration&)>;

constexpr double gap = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_plots = 6;

double scaled(Measure measure, const std::optional<double>& value) {
  if (!value) return gap;
  return measure == Measure::completion ? *value * 1e-9 : *value;
}

plot::Series series_of(const Configurations& configurations, Measure measure, bool after,
                       const Position& position) {
  plot::Series series;
  series.name = after ? "candidate" : "base";
  series.color = after ? 1U : 0U;
  series.spread = plot::Spread::band;
  for (const Configuration* one : configurations) {
    const MeasuredChange& change = (*one)[measure];
    const statistics::Quantiles& values = after ? change.after : change.before;
    series.x.push_back(position(*one));
    series.y.push_back(scaled(measure, values.median));
    series.low.push_back(scaled(measure, values.p10));
    series.high.push_back(scaled(measure, values.p90));
  }
  return series;
}

plot::Chart chart_of(Configurations configurations, Measure measure, const Position& position) {
  std::ranges::stable_sort(configurations, {},
                           [&](const Configuration* one) { return position(*one); });
  plot::Chart chart;
  chart.height = 340;
  chart.description = fmt::format(
      "{}: median and 10 to 90 % range of the runs, with the base and with the candidate.",
      words_of(measure));
  chart.y.label = words_of(measure);
  chart.y.min = 0.0;
  if (measure == Measure::completion) chart.y.unit = "s";
  chart.series = {series_of(configurations, measure, false, position),
                  series_of(configurations, measure, true, position)};
  // Two configurations at one place have no order that a line could follow.
  const auto same_place = std::ranges::adjacent_find(
      configurations,
      [&](const Configuration* a, const Configuration* b) { return position(*a) == position(*b); });
  if (same_place == configurations.end()) return chart;
  for (plot::Series& series : chart.series) {
    series.mark = plot::Mark::points;
    series.spread = plot::Spread::bars;
  }
  return chart;
}

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double last_value(const Configuration& one) {
  return one.values.empty() ? gap : number_in(one.values.back().second).value_or(gap);
}

/// The last part of a key: "deployment.participants_per_host" → "participants_per_host".
std::string short_key(const std::string& key) { return key.substr(key.rfind('.') + 1); }

/// All but the last swept key.
std::string group_name(const Configuration& one) {
  std::string name;
  for (std::size_t k = 0; k + 1 < one.values.size(); ++k) {
    const auto& [key, value] = one.values[k];
    name += fmt::format("{}{} {}", name.empty() ? "" : ", ", short_key(key), value);
  }
  return name;
}

/// Configurations that differ in the last swept key alone; none if that is not a number.
std::vector<std::pair<std::string, Configurations>> groups_of(const CostComparison& costs) {
  std::vector<std::pair<std::string, Configurations>> groups;
  for (const Configuration& one : costs.configurations) {
    if (one.values.size() < 2 || std::isnan(last_value(one))) return {};
    const std::string name = group_name(one);
    auto found = std::ranges::find(groups, name, [](const auto& group) { return group.first; });
    if (found == groups.end()) found = groups.insert(groups.end(), {name, {}});
    found->second.push_back(&one);
  }
  const bool readable =
      groups.size() <= most_plots &&
      std::ranges::all_of(groups, [](const auto& group) { return group.second.size() > 1; });
  if (!readable) groups.clear();
  return groups;
}

}  // namespace

std::vector<std::string> measure_plots(const CostComparison& costs, Measure measure) {
  if (costs.configurations.size() < 2) return {};  // a point is no curve; tables say it
  Configurations all;
  for (const Configuration& one : costs.configurations) all.push_back(&one);
  plot::Chart whole = chart_of(std::move(all), measure, [](const Configuration& one) {
    return static_cast<double>(one.descriptors);
  });
  whole.title = fmt::format("{} over the load", words_of(measure));
  whole.x = {.label = "descriptors to be delivered across hosts", .scale = plot::Scale::log};
  std::vector<std::string> plots;
  const bool is_one_load = std::ranges::all_of(costs.configurations, [&](const Configuration& one) {
    return one.descriptors == costs.configurations.front().descriptors;
  });
  if (!is_one_load || groups_of(costs).empty()) plots.push_back(to_svg(whole));
  for (const auto& [name, configurations] : groups_of(costs)) {
    plot::Chart chart = chart_of(configurations, measure, last_value);
    chart.title = fmt::format("{} at {}", words_of(measure), name);
    chart.x = {.label = short_key(configurations.front()->values.back().first)};
    plots.push_back(to_svg(chart));
  }
  return plots;
}

std::string classes_plot(const Configuration& configuration) {
  static constexpr std::array classes{
      Measure::initial_data,   Measure::repair_data,  Measure::heartbeat,   Measure::acknack,
      Measure::spdp_multicast, Measure::spdp_unicast, Measure::user_control};
  plot::BarChart chart;
  chart.title = "Messages by class at " + configuration.name;
  chart.description = "Median number of messages of each class, with the base and the candidate.";
  chart.value = {.label = "messages (median)", .min = 0.0};
  chart.groups = {{"base", {}}, {"candidate", {}}};
  for (const Measure measure : classes) {
    const MeasuredChange& change = configuration[measure];
    const double before = change.before.median.value_or(gap);
    const double after = change.after.median.value_or(gap);
    if (!(before > 0) && !(after > 0)) continue;
    chart.categories.emplace_back(words_of(measure));
    chart.groups[0].values.push_back(before);
    chart.groups[1].values.push_back(after);
  }
  return chart.categories.empty() ? std::string{} : to_svg(chart);
}

std::vector<const Configuration*> notable(const CostComparison& costs) {
  if (costs.configurations.empty()) return {};
  const auto change_of = [](const Configuration& one) {
    const MeasuredChange& change = one[Measure::messages];
    return std::abs(change.relative.value_or(0));
  };
  const auto& all = costs.configurations;
  const auto loaded = std::ranges::max_element(all, {}, &Configuration::descriptors);
  const auto changed = std::ranges::max_element(all, {}, change_of);
  std::vector<const Configuration*> chosen{&*loaded};
  if (changed != loaded && change_of(*changed) > 0) chosen.push_back(&*changed);
  return chosen;
}

}  // namespace stormproof::diff
