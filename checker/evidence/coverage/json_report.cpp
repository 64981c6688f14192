// The JSON form of a comparison.
#include <cmath>

#include <nlohmann/json.hpp>

#include "checker/evidence/coverage/report.hpp"
#include "checker/presentation/text/assumptions.hpp"

namespace stormproof::prediction {

namespace {

using OrderedJson = nlohmann::ordered_json;

/// Infinite values stand for runs that did not complete; JSON has no number for them.
OrderedJson number(double value) {
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}
OrderedJson number(const std::optional<double>& value) {
  return value ? number(*value) : OrderedJson(nullptr);
}

OrderedJson row_json(const ProfileStudy& profile, const FitRow& row) {
  const Fit& fit = row.fit;
  OrderedJson calibration = OrderedJson::object();
  for (std::size_t k = 0; k < calibration_points; ++k) {
    calibration["0." + std::to_string(k + 1)] = fit.calibration[k];
  }
  return {{"profile", profile.name},
          {"scope", row.scope},
          {"class", name_of(row.measure)},
          {"configurations", fit.configurations},
          {"runs", fit.runs},
          {"incomplete_runs", fit.incomplete_runs},
          {"undecided_runs", fit.undecided_runs},
          {"model_runs", fit.model_runs},
          {"incomplete_model_runs", fit.incomplete_model_runs},
          {"undecided_configurations", fit.undecided_configurations},
          {"coverage", fit.coverage},
          {"covered_ratio_q1", number(fit.covered_q1)},
          {"covered_ratio_median", number(fit.covered_median)},
          {"covered_ratio_q3", number(fit.covered_q3)},
          {"median_ratio", number(fit.median_ratio)},
          {"median_abs_ln_ratio", number(fit.median_abs_ln_ratio)},
          {"mape", number(fit.mean_absolute_percent)},
          {"mape_configurations", fit.percent_configurations},
          {"in_range", fit.in_range},
          {"calibration", calibration}};
}

OrderedJson estimate_json(const RatioEstimate& estimate) {
  return {{"configurations", estimate.configurations},
          {"median", number(estimate.median)},
          {"low", number(estimate.low)},
          {"high", number(estimate.high)}};
}

OrderedJson effect_json(const ProfileStudy& profile, const Effect& effect) {
  return {{"profile", profile.name},
          {"scope", effect.scope},
          {"class", name_of(effect.measure)},
          {"predicted", estimate_json(effect.predicted)},
          {"observed", effect.observed ? estimate_json(*effect.observed) : OrderedJson(nullptr)},
          {"verdict", name_of(effect.verdict)}};
}

OrderedJson configuration_json(const Pairing& pairing) {
  const Configuration& c = *pairing.observed;
  OrderedJson observed;
  OrderedJson predicted;
  for (std::size_t m = 0; m < measure_count; ++m) {
    const auto measure = static_cast<Measure>(m);
    const std::vector<double> runs = observed_values(c, measure);
    if (!runs.empty()) observed[name_of(measure)] = number(quantile(runs, 0.5));
    predicted[name_of(measure)] = number(quantile(pairing.predicted->values[m], 0.5));
  }
  return {{"set", c.set},
          {"N_H", c.hosts},
          {"N_P", c.participants_per_host},
          {"N_E", c.endpoints},
          {"runs", c.runs.size()},
          {"model_runs", pairing.predicted->values[0].size()},
          {"observed_median", observed},
          {"predicted_median", predicted}};
}

}  // namespace

OrderedJson to_json(const Heading& heading, const Study& study) {
  OrderedJson json;
  json["observations"] = heading.observations;
  json["command"] = heading.command;
  json["wireless"] = heading.wireless;
  json["samples"] = heading.samples;
  json["seed"] = heading.first_seed;
  json["read"] = heading.rows;
  json["not_selected"] = heading.not_selected;
  json["interrupted"] = study.interrupted;
  json["profiles"] = OrderedJson::array();
  json["rows"] = OrderedJson::array();
  json["effects"] = OrderedJson::array();
  for (const ProfileStudy& profile : study.profiles) {
    OrderedJson configurations = OrderedJson::array();
    for (const Pairing& pairing : profile.pairings()) {
      configurations.push_back(configuration_json(pairing));
    }
    json["profiles"].push_back({{"name", profile.name},
                                {"baseline", profile.is_baseline},
                                {"sampled", profile.sampled},
                                {"skipped_runs", OrderedJson(profile.skipped)},
                                {"configurations", configurations}});
    report::add_unmodelled(json["profiles"].back(), profile.dds);
    for (const FitRow& row : profile.rows) json["rows"].push_back(row_json(profile, row));
    for (const Effect& e : profile.effects) json["effects"].push_back(effect_json(profile, e));
  }
  return json;
}

}  // namespace stormproof::prediction
