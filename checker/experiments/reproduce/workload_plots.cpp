// Plots over the workload. Values are drawn block by block: one block for each N_P, in it N_E from
// left to right, so that all configurations fit on one axis.
#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/plot_style.hpp"
#include "checker/experiments/reproduce/plots.hpp"
#include "checker/presentation/charts/plot.hpp"

namespace stormproof::reproduce {

namespace {

using model::HeartbeatPolicy;

constexpr double block_width = 0.85;  // of the distance between two N_P
constexpr std::size_t reference_color = 6;
constexpr int wide = 1160;

/// Where a configuration lies on the axis of the workload.
class Workload {
 public:
  explicit Workload(const Plan& plan) {
    for (const Configuration& one : plan.configurations) {
      least_ = std::min(least_, one.endpoints_per_participant);
      most_ = std::max(most_, one.endpoints_per_participant);
    }
    for (const std::uint32_t np : participant_counts(plan)) ticks_.push_back(np);
    from_ = least_;
    to_ = most_;
  }

  [[nodiscard]] double x(const Configuration& one) const {
    const double span = most_ > least_ ? static_cast<double>(most_ - least_) : 1.0;
    return one.participants_per_host +
           block_width * static_cast<double>(one.endpoints_per_participant - least_) / span;
  }
  [[nodiscard]] plot::Axis axis() const {
    plot::Axis axis;
    axis.label = fmt::format("N_P, participants per host; in each block N_E = {} … {}", from_, to_);
    axis.min = ticks_.front() - 0.15;
    axis.max = ticks_.back() + 1.0;
    axis.ticks = ticks_;
    return axis;
  }

 private:
  std::uint32_t least_ = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t most_ = 0;
  std::uint32_t from_ = 0;
  std::uint32_t to_ = 0;
  std::vector<double> ticks_;
};

/// One point for each configuration, with a gap between two N_P.
template <class Value>
plot::Series over_workload(const Plan& plan, std::string name, Value value) {
  const Workload workload{plan};
  plot::Series series;
  series.name = std::move(name);
  for (const std::uint32_t np : participant_counts(plan)) {
    for (const Configuration& one : plan.configurations) {
      if (one.participants_per_host != np) continue;
      series.x.push_back(workload.x(one));
      series.y.push_back(value(one).value_or(gap));
    }
    series.x.push_back(gap);
    series.y.push_back(gap);
  }
  return series;
}

/// A level line in the block of each N_P at its published mean.
plot::Series published_means(const Report& report, const std::string& quantity,
                             const std::string& which, std::size_t color) {
  plot::Series series;
  series.name = "published mean" + (which == "adaptive" ? std::string{", adaptive"} : "");
  series.mark = plot::Mark::line;
  series.color = color;
  for (const std::uint32_t np : participant_counts(report.results.plan)) {
    const std::string id = fmt::format("observed_means.np{}.{}.{}", np, quantity, which);
    const double value =
        report.published.find(id) == nullptr ? gap : report.published.values(id).front();
    for (const double x : {np + 0.0, np + block_width, gap}) {
      series.x.push_back(x);
      series.y.push_back(value);
    }
  }
  return series;
}

plot::Chart workload_chart(const Report& report, std::string title, std::string description) {
  plot::Chart chart;
  chart.title = std::move(title);
  chart.description = std::move(description);
  chart.x = Workload{report.results.plan}.axis();
  chart.y.scale = plot::Scale::log;
  chart.width = wide;
  chart.height = 440;
  return chart;
}

/// The fastest and slowest of several runs, as a band.
void add_band(const Report& report, std::size_t variant, plot::Series& series) {
  if (report.results.plan.variants[variant].runs < 2) return;
  const auto of = [&](auto value) {
    return over_workload(report.results.plan, "", [&](const Configuration& one) {
      const Outcome* outcome = report.results.find(variant, Network::wireless, one);
      return outcome ? value(*outcome) : std::nullopt;
    });
  };
  series.low = of([](const Outcome& outcome) { return outcome.fastest_s(); }).y;
  series.high = of([](const Outcome& outcome) { return outcome.slowest_s(); }).y;
  series.spread = plot::Spread::band;
}

void add_reference(plot::Chart& chart, plot::Series series) {
  series.mark = plot::Mark::dashed_line;
  series.color = reference_color;
  chart.series.push_back(std::move(series));
}

}  // namespace

std::string environments_plot(const Report& report, std::size_t variant, Class what) {
  const Measures measures{report.results};
  plot::Chart chart = workload_chart(
      report,
      fmt::format("{}, {}", what == Class::total ? "Total messages" : "ACKNACKs",
                  variant_name(report, variant)),
      "Loopback (normalised), wired and Wi-Fi over the workload, with the failure-free reference.");
  chart.width = plot::beside;
  chart.height = 340;
  chart.x.label = "N_P; in each block N_E grows";
  const auto on = [&](Network network) {
    return [&, network](const Configuration& one) {
      const Outcome* outcome = report.results.find(variant, network, one);
      return outcome ? outcome->messages(what) : std::nullopt;
    };
  };
  const Plan& plan = report.results.plan;
  chart.series.push_back(over_workload(plan, "Wi-Fi", on(Network::wireless)));
  chart.series.push_back(over_workload(plan, "loopback", [&](const Configuration& one) {
    return measures.loopback_messages(variant, what, one);
  }));
  // Last, as a line through the points of loopback where they are equal.
  chart.series.push_back(over_workload(plan, "wired", on(Network::wired)));
  for (plot::Series& series : chart.series) series.mark = plot::Mark::line;
  chart.series[1].mark = plot::Mark::points;
  plot::Series reference = over_workload(plan, "failure-free", [&](const Configuration& one) {
    return std::optional{measures.reference_messages(variant, what, one)};
  });
  add_reference(chart, std::move(reference));
  return to_svg(chart);
}

std::string completion_plot(const Report& report) {
  const Measures measures{report.results};
  const Plan& plan = report.results.plan;
  plot::Chart chart = workload_chart(
      report, "Completion on Wi-Fi over the workload",
      "Closed-loop model, open-loop airtime of the first variant, and published means by N_P.");
  chart.y.label = "completion";
  chart.y.unit = "s";
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    plot::Series series =
        over_workload(plan, variant_name(report, v), [&](const Configuration& one) {
          const Outcome* outcome = report.results.find(v, Network::wireless, one);
          return outcome ? outcome->completion_s() : std::nullopt;
        });
    add_band(report, v, series);
    series.color = color_of(v);
    chart.series.push_back(std::move(series));
  }
  chart.series.push_back(published_means(report, "completion_s", "baseline", published_color));
  if (!plan.variants.empty()) {
    plot::Series open = over_workload(plan, "open loop", [&](const Configuration& one) {
      return std::optional{measures.open_loop_s(0, one)};
    });
    add_reference(chart, std::move(open));
  }
  return to_svg(chart);
}

std::string messages_plot(const Report& report) {
  const Measures measures{report.results};
  const Plan& plan = report.results.plan;
  plot::Chart chart = workload_chart(
      report, "Total messages on Wi-Fi over the workload",
      "Closed-loop model, failure-free reference of the first variant, published means by N_P.");
  chart.y.label = "messages up to completion";
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    plot::Series series =
        over_workload(plan, variant_name(report, v), [&](const Configuration& one) {
          const Outcome* outcome = report.results.find(v, Network::wireless, one);
          return outcome ? outcome->messages(Class::total) : std::nullopt;
        });
    series.color = color_of(v);
    chart.series.push_back(std::move(series));
  }
  chart.series.push_back(published_means(report, "messages", "baseline", published_color));
  if (!plan.variants.empty()) {
    plot::Series reference = over_workload(plan, "failure-free", [&](const Configuration& one) {
      return std::optional{measures.reference_messages(0, Class::total, one)};
    });
    add_reference(chart, std::move(reference));
  }
  return to_svg(chart);
}

std::string policies_plot(const Report& report, std::size_t variant) {
  plot::Chart chart = workload_chart(
      report, fmt::format("HEARTBEAT policies: completion, {}", variant_name(report, variant)),
      "The periodic and the adaptive policy on Wi-Fi, and the published means of both.");
  chart.width = plot::beside;
  chart.height = 360;
  chart.x.label = "N_P; in each block N_E grows";
  chart.y.label = "completion";
  chart.y.unit = "s";
  const auto with = [&](HeartbeatPolicy policy) {
    return [&, policy](const Configuration& one) {
      const Outcome* outcome =
          report.results.find({variant, Network::wireless, policy, orders[0], one});
      return outcome ? outcome->completion_s() : std::nullopt;
    };
  };
  chart.series.push_back(
      over_workload(report.results.plan, "periodic", with(HeartbeatPolicy::periodic)));
  chart.series.push_back(
      over_workload(report.results.plan, "adaptive", with(HeartbeatPolicy::adaptive)));
  chart.series[0].mark = plot::Mark::line;
  chart.series[1].mark = plot::Mark::points;
  chart.series.push_back(published_means(report, "completion_s", "baseline", published_color));
  chart.series.push_back(published_means(report, "completion_s", "adaptive", reference_color));
  return to_svg(chart);
}

std::string spreads_plot(const Report& report) {
  const Measures measures{report.results};
  plot::Chart chart = workload_chart(
      report, "Completion: spread over three orders of service",
      "(largest - least) / largest, in percent; the published median and maximum as lines.");
  chart.y.scale = plot::Scale::linear;
  chart.y.label = "spread in %";
  chart.width = plot::beside;
  chart.height = 360;
  for (std::size_t v = 0; v < report.results.plan.variants.size(); ++v) {
    if (report.results.plan.variants[v].staggered) continue;
    plot::Series series =
        over_workload(report.results.plan, variant_name(report, v), [&](const Configuration& one) {
          const auto spread = measures.completion_spread(v, one);
          return spread ? std::optional{*spread * 100} : std::nullopt;
        });
    series.mark = plot::Mark::points;
    series.color = color_of(v);
    chart.series.push_back(std::move(series));
  }
  for (const auto& [id, label] : {std::pair{"completion_max_pct", "published maximum"},
                                  std::pair{"completion_median_pct", "published median"}}) {
    const auto& values = report.published.values(fmt::format("ordering_policy_spread.{}", id));
    if (!values.empty()) {
      chart.references.push_back({plot::Reference::Kind::horizontal, values.front(), label});
    }
  }
  return to_svg(chart);
}

}  // namespace stormproof::reproduce
