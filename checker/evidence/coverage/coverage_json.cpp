// The comparison as JSON; specs/guide/coverage.md explains the keys.
#include <cmath>
#include <map>

#include "checker/evidence/coverage/report.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::prediction {

template <class V>
void describe(V& v, const RatioEstimate& estimate) {
  v("configuration_count", estimate.configurations);
  v("estimate", estimate.median);
  v("low", estimate.low);
  v("high", estimate.high);
}

namespace {

/// What stands in one list for all profiles.
template <class Row>
struct OfProfile {
  const ProfileStudy& profile;
  const Row& row;
};

template <class V>
void describe(V& v, const OfProfile<FitRow>& one) {
  const Fit& fit = one.row.fit;
  std::map<std::string, double> calibration;
  for (std::size_t k = 0; k < calibration_points; ++k) {
    calibration["0." + std::to_string(k + 1)] = fit.calibration[k];
  }
  v("profile", one.profile.name);
  v("scope", one.row.scope);
  v("class", one.row.measure);
  v("configuration_count", fit.configurations);
  v("runs", fit.runs);
  v("incomplete_runs", fit.incomplete_runs);
  v("undecided_runs", fit.undecided_runs);
  v("model_runs", fit.model_runs);
  v("incomplete_model_runs", fit.incomplete_model_runs);
  v("undecided_configurations", fit.undecided_configurations);
  v("coverage", fit.coverage);
  v("covered_ratio_q1", fit.covered_q1);
  v("covered_ratio_median", fit.covered_median);
  v("covered_ratio_q3", fit.covered_q3);
  v("median_ratio", fit.median_ratio);
  v("median_abs_ln_ratio", fit.median_abs_ln_ratio);
  v("mape", fit.mean_absolute_percent);
  v("mape_configurations", fit.percent_configurations);
  v.unless_empty("near", fit.near);
  v("in_range", fit.in_range);
  v("calibration", calibration);
}

template <class V>
void describe(V& v, const OfProfile<Effect>& one) {
  v("profile_name", one.profile.name);
  v("scope", one.row.scope);
  v("class", one.row.measure);
  v("predicted", one.row.predicted);
  v("observed", one.row.observed);
  v("verdict", one.row.verdict);
}

}  // namespace

namespace {

/// By measure; completion in ns.
void add_median(std::map<std::string, double>& medians, Measure measure, double median) {
  if (measure == Measure::completion) {
    medians["t_disc_ns"] = std::round(median * 1e6);
  } else if (measure == Measure::recovery) {
    medians["recovery_ns"] = std::round(median * 1e6);
  } else {
    medians[name_of(measure)] = median;
  }
}

}  // namespace

template <class V>
void describe(V& v, const Pairing& pairing) {
  const Configuration& measured = *pairing.observed;
  std::map<std::string, double> observed;
  std::map<std::string, double> predicted;
  for (std::size_t m = 0; m < measure_count; ++m) {
    const auto measure = static_cast<Measure>(m);
    const std::vector<double> runs = observed_values(measured, measure);
    if (!runs.empty()) add_median(observed, measure, quantile(runs, 0.5));
    const std::vector<double>& model = pairing.predicted->values[m];
    if (!model.empty()) add_median(predicted, measure, quantile(model, 0.5));
  }
  v("set", measured.set);
  v("N_H", measured.hosts);
  v("N_P", measured.participants_per_host);
  v("N_E", measured.endpoints);
  v("step_ns", nanoseconds(measured.spread.step_ms));
  v("limit_ns", measured.limit() ? std::optional{nanoseconds(*measured.limit())} : std::nullopt);
  v("runs", measured.runs.size());
  v("model_runs", pairing.predicted->values[0].size());
  v("observed_median", observed);
  v("predicted_median", predicted);
}

template <class V>
void describe(V& v, const ProfileStudy& profile) {
  v("profile_name", profile.name);
  v("baseline", profile.is_baseline);
  v("sampled", profile.sampled);
  v("measured_starts", profile.measured_starts);
  v("skipped_runs", profile.skipped);
  v("configurations", profile.pairings());
  v.unless_empty("unmodelled", profile.dds.unmodelled);
}

static Pairing example_of(report::Type<Pairing>) {
  static const Configuration observed;
  static const Prediction predicted = [] {
    Prediction one;
    one.values.fill({0});
    return one;
  }();
  return {&observed, &predicted};
}

namespace {

struct StudyWithHeading {
  const Heading& heading;
  const Study& study;
};

template <class V>
void describe(V& v, const StudyWithHeading& shown) {
  const Heading& heading = shown.heading;
  std::vector<OfProfile<FitRow>> rows;
  std::vector<OfProfile<Effect>> effects;
  for (const ProfileStudy& profile : shown.study.profiles) {
    for (const FitRow& row : profile.rows) rows.push_back({profile, row});
    for (const Effect& effect : profile.effects) effects.push_back({profile, effect});
  }
  v("observations", heading.observations);
  v("wireless", heading.wireless);
  v("wanted", heading.samples);
  v("seed", heading.first_seed);
  v("read", heading.rows);
  v("not_selected", heading.not_selected);
  v("profiles", shown.study.profiles);
  v("rows", rows);
  v("effects", effects);
}

}  // namespace

nlohmann::ordered_json to_json(const Heading& heading, const Study& study) {
  return report::json_of(StudyWithHeading{heading, study});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<StudyWithHeading>(definitions);
}

}  // namespace stormproof::prediction
