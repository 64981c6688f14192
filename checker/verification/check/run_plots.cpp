// Samples a run at so many events that a plot has a few hundred points, however long the run is.
#include "checker/verification/check/run_plots.hpp"

#include <array>

#include <fmt/format.h>

#include "checker/presentation/charts/plot.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "model/engine/packet.hpp"
#include "model/simulator.hpp"

namespace stormproof::report {

namespace {

using model::TrafficClass;

struct Sample {
  double seconds = 0;
  std::array<double, model::traffic_class_count> packets{};
  double missing = 0;
  double backlog = 0;
};

class Sampler final : public model::Probe {
 public:
  void event_started(const model::Event& event) override {
    now_.seconds = static_cast<double>(event.time.count()) * 1e-9;
  }
  void event_finished(const model::Depths& depths) override {
    now_.missing = static_cast<double>(depths.missing);
    now_.backlog = static_cast<double>(depths.backlog_packets);
    if (++event_ % stride_ != 0) return;
    samples_.push_back(now_);
    if (samples_.size() < most_samples) return;
    for (std::size_t k = 0; 2 * k + 1 < samples_.size(); ++k) samples_[k] = samples_[2 * k + 1];
    samples_.resize(samples_.size() / 2);
    stride_ *= 2;
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t> destinations) override {
    const bool single = packet.multicast() || destinations.empty();
    now_.packets[static_cast<std::size_t>(traffic_class(packet))] +=
        single ? 1.0 : static_cast<double>(destinations.size());
  }
  std::vector<Sample> finish() && {
    samples_.push_back(now_);
    return std::move(samples_);
  }

 private:
  static constexpr std::size_t most_samples = 400;
  std::vector<Sample> samples_;
  Sample now_;
  std::uint64_t event_ = 0;
  std::uint64_t stride_ = 1;
};

plot::Series series(std::string name, const std::vector<Sample>& samples, std::size_t color,
                    const std::function<double(const Sample&)>& value) {
  plot::Series result;
  result.name = std::move(name);
  result.mark = plot::Mark::line;
  result.color = color;
  for (const Sample& sample : samples) {
    result.x.push_back(sample.seconds);
    result.y.push_back(value(sample));
  }
  return result;
}

std::string missing_plot(const std::vector<Sample>& samples) {
  plot::Chart chart;
  chart.title = "What is missing, and what waits";
  chart.description =
      "Descriptors that their receivers still lack, and packets that wait for room in a source "
      "queue, over time.";
  chart.x = {.label = "time", .unit = "s"};
  chart.y = {.label = "descriptors, packets", .min = 0.0};
  chart.series = {
      series("missing descriptors", samples, 0, [](const Sample& s) { return s.missing; }),
      series("packets in the backlog", samples, 1, [](const Sample& s) { return s.backlog; })};
  return to_svg(chart);
}

std::string packets_plot(const std::vector<Sample>& samples) {
  plot::Chart chart;
  chart.title = "Packets sent so far";
  chart.description = "Packets that participants have generated, by class, over time.";
  chart.x = {.label = "time", .unit = "s"};
  chart.y = {.label = "packets", .min = 0.0};
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    if (samples.back().packets[k] == 0) continue;
    chart.series.push_back(series(words_of(static_cast<model::TrafficClass>(k)), samples, k,
                                  [k](const Sample& s) { return s.packets[k]; }));
  }
  return to_svg(chart);
}

std::string end_text(const model::RunResult& result) {
  if (result.discovery_time) return "Discovery completes after " + duration(*result.discovery_time);
  if (result.end == model::RunEnd::interrupted) {
    return fmt::format("Shown are its first {} events", grouped(result.events));
  }
  return fmt::format("Discovery does not complete; {} descriptors are missing at {}",
                     grouped(result.missing_count), duration(result.end_time));
}

}  // namespace

RunPlots run_plots(const model::Scenario& scenario, std::uint64_t max_events) {
  Sampler sampler;
  model::RunOptions options;
  options.probe = &sampler;
  options.max_events = max_events;
  const model::RunResult result = simulate(scenario, options);
  const std::vector<Sample> samples = std::move(sampler).finish();
  const bool drawn = scenario.deployment.schedule.has_value();
  return {
      {missing_plot(samples), packets_plot(samples)},
      fmt::format("{}. {} packets count, however many descriptors they carry.", end_text(result),
                  drawn ? "This is one run of many: start times are drawn. Here"
                        : "This is the one run of the scenario. Here")};
}

}  // namespace stormproof::report
