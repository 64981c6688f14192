// Model against measurement, and calibration, as charts.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "checker/evidence/coverage/report.hpp"
#include "checker/presentation/charts/plot.hpp"

namespace stormproof::prediction {

namespace {

/// The name of a profile without folder and ending, for titles and file names.
std::string short_name(const std::string& profile) {
  return std::filesystem::path{profile}.extension() == ".yaml"
             ? std::filesystem::path{profile}.stem().string()
             : std::filesystem::path{profile}.filename().string();
}

bool is_reported(const ProfileStudy& profile, const Configuration& configuration) {
  return std::ranges::any_of(profile.rows,
                             [&](const FitRow& row) { return in_scope(configuration, row.scope); });
}

/// Points of one N_P: measured median against the median of the model, with 10–90 % of the runs.
plot::Series points(const ProfileStudy& profile, std::uint32_t participants, Measure measure) {
  const double scale = measure == Measure::completion ? 1e-3 : 1;
  plot::Series series;
  series.name = fmt::format("N_P = {}", participants);
  series.mark = plot::Mark::points;
  for (const Pairing& pairing : profile.pairings()) {
    if (pairing.observed->participants_per_host != participants) continue;
    if (!is_reported(profile, *pairing.observed)) continue;
    const std::vector<double> observed = observed_values(*pairing.observed, measure);
    const auto& model = pairing.predicted->values[static_cast<std::size_t>(measure)];
    if (observed.empty()) continue;
    series.x.push_back(scale * quantile(observed, 0.5));
    series.y.push_back(scale * quantile(model, 0.5));
    series.low.push_back(scale * quantile(model, 0.1));
    series.high.push_back(scale * quantile(model, 0.9));
  }
  return series;
}

plot::Chart scatter(const ProfileStudy& profile, Measure measure) {
  const bool time = measure == Measure::completion;
  const std::string what = time ? "completion" : "messages";
  plot::Chart chart;
  chart.title = fmt::format("{}: {}", short_name(profile.name), what);
  chart.description = "Predicted against measured " + what +
                      "; a point for each configuration, medians; bars: 10 to 90 % of the "
                      "model runs; the line: prediction equals measurement";
  chart.x = {"measured (median)", plot::Scale::log, {}, {}, time ? "s" : "", {}};
  chart.y = {"predicted (median, 10–90 %)", plot::Scale::log, {}, {}, time ? "s" : "", {}};
  std::vector<std::uint32_t> participants;
  for (const Configuration& c : profile.configurations) {
    if (std::ranges::count(participants, c.participants_per_host) == 0) {
      participants.push_back(c.participants_per_host);
    }
  }
  for (const std::uint32_t n : participants) {
    plot::Series series = points(profile, n, measure);
    if (!series.x.empty()) chart.series.push_back(std::move(series));
  }
  chart.references.push_back({plot::Reference::Kind::diagonal, 0, "equal"});
  return chart;
}

plot::Chart calibration(const ProfileStudy& profile) {
  plot::Chart chart;
  chart.title = short_name(profile.name) + ": calibration";
  chart.description =
      "Share of measured runs up to each quantile of the model runs; the line: exactly calibrated";
  chart.x = {"quantile of the model runs", plot::Scale::linear, 0.0, 1.0, "", {}};
  chart.y = {"share of measured runs", plot::Scale::linear, 0.0, 1.0, "", {}};
  const std::string& scope = profile.overall_scope();
  for (const FitRow& row : profile.rows) {
    if (row.scope != scope) continue;
    if (row.measure != Measure::completion && row.measure != Measure::messages) continue;
    plot::Series series;
    series.name = row.measure == Measure::completion ? "completion" : "messages";
    for (std::size_t k = 0; k < calibration_points; ++k) {
      series.x.push_back(static_cast<double>(k + 1) / 10);
      series.y.push_back(row.fit.calibration[k]);
    }
    chart.series.push_back(std::move(series));
  }
  chart.references.push_back({plot::Reference::Kind::diagonal, 0, "calibrated"});
  return chart;
}

}  // namespace

std::vector<ChartFile> charts(const ProfileStudy& profile) {
  if (profile.rows.empty()) return {};
  const std::string name = short_name(profile.name);
  std::vector<ChartFile> files{
      {name + "-completion.svg", to_svg(scatter(profile, Measure::completion))},
      {name + "-messages.svg", to_svg(scatter(profile, Measure::messages))}};
  if (profile.sampled) files.push_back({name + "-calibration.svg", to_svg(calibration(profile))});
  return files;
}

}  // namespace stormproof::prediction
