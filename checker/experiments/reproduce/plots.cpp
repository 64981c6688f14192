// Plots of statistics: counts by class, the ratio surface, model beside observation.
#include "checker/experiments/reproduce/plots.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/plot_style.hpp"
#include "checker/presentation/charts/axis.hpp"
#include "checker/presentation/charts/plot.hpp"

namespace stormproof::reproduce {

namespace {

using model::HeartbeatPolicy;

/// Of all classes on all networks, a little widened: charts that stand side by side have one axis.
std::pair<double, double> range_of_counts(const Report& report) {
  plot::DataRange range{plot::Scale::log};
  for (const Network network : {Network::wired, Network::wireless}) {
    for (const Class what : table_classes) {
      for (const double value : report.published.values(
               fmt::format("repair_amplification.{}.{}", name_of(network), name_of(what)))) {
        range.add(value);
      }
      for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
        const Outcome* outcome = report.results.find(v, network, {5, 20});
        if (outcome) range.add(outcome->messages(what).value_or(gap));
      }
    }
  }
  return {range.low() / 1.5, range.high() * 1.5};
}

/// Of all variants at all sizes: surfaces that stand side by side have the same colours.
std::pair<double, double> range_of_ratios(const Report& report) {
  const Measures measures{report.results};
  plot::DataRange range{plot::Scale::log};
  for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
    for (const Configuration& one : report.results.plan.configurations) {
      range.add(measures.wireless_to_wired(v, one).value_or(gap));
    }
  }
  return {range.low(), range.high()};
}

}  // namespace

std::string counts_plot(const Report& report, Network network) {
  plot::BarChart chart;
  chart.title = fmt::format("Messages by class, N_P 5, N_E 20, {}", name_of(network));
  chart.description = "Published means and the model, on a logarithmic scale.";
  chart.value.label = "messages";
  chart.value.scale = plot::Scale::log;
  std::tie(chart.value.min, chart.value.max) = range_of_counts(report);
  plot::BarChart::Group published{"published", {}};
  for (const Class what : table_classes) {
    chart.categories.emplace_back(name_of(what));
    const auto& values = report.published.values(
        fmt::format("repair_amplification.{}.{}", name_of(network), name_of(what)));
    published.values.push_back(values.empty() ? gap : values.front());
  }
  chart.groups.push_back(std::move(published));
  for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
    const Outcome* outcome = report.results.find(v, network, {5, 20});
    plot::BarChart::Group group{variant_name(report, v), {}};
    for (const Class what : table_classes) {
      group.values.push_back(outcome ? outcome->messages(what).value_or(gap) : gap);
    }
    chart.groups.push_back(std::move(group));
  }
  return to_svg(chart);
}

std::string surface_plot(const Report& report, std::size_t variant) {
  const Measures measures{report.results};
  plot::HeatMap map;
  map.title = fmt::format("Wi-Fi / wired total messages, {}", variant_name(report, variant));
  map.description = "The ratio at each system size; the colour follows its logarithm.";
  map.x_label = "N_E, endpoints per participant";
  map.y_label = "N_P, participants per host";
  map.value_label = "ratio";
  map.scale = plot::Scale::log;
  std::tie(map.min, map.max) = range_of_ratios(report);
  map.width = plot::beside;
  std::set<std::uint32_t> columns;
  for (const Configuration& one : report.results.plan.configurations) {
    columns.insert(one.endpoints_per_participant);
  }
  for (const std::uint32_t ne : columns) map.x.push_back(std::to_string(ne));
  for (const std::uint32_t np : participant_counts(report.results.plan)) {
    map.y.push_back(std::to_string(np));
    map.value.emplace_back();
    for (const std::uint32_t ne : columns) {
      map.value.back().push_back(measures.wireless_to_wired(variant, {np, ne}).value_or(gap));
    }
  }
  return to_svg(map);
}

std::string ratio_plot(const Report& report, const std::string& quantity) {
  const Plan& plan = report.results.plan;
  const bool messages = quantity == "messages";
  plot::Chart chart;
  chart.title = messages ? "Total messages: model mean / observed mean"
                         : "Completion: model mean / observed mean";
  chart.description =
      "By participants per host; 1 is agreement. Marks without a line: the published median "
      "ratio of the paper's model over the runs that it covers.";
  chart.x.label = "N_P, participants per host";
  chart.y.label = "model / observed";
  chart.y.scale = plot::Scale::log;
  chart.height = 360;
  chart.references.push_back({plot::Reference::Kind::horizontal, 1, "equal"});
  const std::set<std::uint32_t> counts = participant_counts(plan);
  for (const std::uint32_t np : counts) chart.x.ticks.push_back(np);
  chart.x.min = *counts.begin() - 0.3;
  chart.x.max = *counts.rbegin() + 0.3;
  const Measures measures{report.results};
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    plot::Series series{variant_name(report, v)};
    series.color = color_of(v);
    for (const std::uint32_t np : counts) {
      const auto model = messages ? measures.mean_messages(v, HeartbeatPolicy::periodic, np)
                                  : measures.mean_completion_s(v, HeartbeatPolicy::periodic, np);
      const auto& observed =
          report.published.values(fmt::format("observed_means.np{}.{}.baseline", np, quantity));
      series.x.push_back(np);
      series.y.push_back(model && !observed.empty() ? *model / observed.front() : gap);
    }
    chart.series.push_back(std::move(series));
  }
  plot::Series published{"published median of covered runs"};
  published.color = published_color;
  published.mark = plot::Mark::points;
  for (const std::uint32_t np : counts) {
    const auto& median = report.published.values(
        fmt::format("upper_range.np{}.{}.median", np, messages ? "messages" : "completion"));
    published.x.push_back(np);
    published.y.push_back(median.empty() ? gap : median.front());
  }
  chart.series.push_back(std::move(published));
  return to_svg(chart);
}

}  // namespace stormproof::reproduce
