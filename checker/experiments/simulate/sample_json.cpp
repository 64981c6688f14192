// The JSON form of sampled runs.
#include <algorithm>

#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/presentation/json/describe_model.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::trials {

template <class V>
void describe(V& v, const Sample& sample) {
  nlohmann::ordered_json counts = report::json_of(sample.counts);
  counts["user_control"] = sample.user_control;
  v("seed", sample.seed);
  v("completed", sample.discovery_time.has_value());
  v("end", sample.end);
  v("t_disc_ns", sample.discovery_time);
  v("counts", counts);
  v("user_control", sample.user_control);
  v("events", sample.events);
}

}  // namespace stormproof::trials

namespace stormproof::report {

template <class V>
void describe(V& v, const SampleSummary& summary) {
  nlohmann::ordered_json counts;
  const auto entries = model::Counts{}.entries();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    counts[entries[k].name] = json_of(summary.counts[k]);
  }
  counts["total"] = json_of(summary.total);
  const auto runs = static_cast<double>(std::max<std::size_t>(summary.runs, 1));
  v("runs", summary.runs);
  v("completed", summary.completed);
  v("completed_share", static_cast<double>(summary.completed) / runs);
  v("t_disc_ns", summary.discovery_time_ns);
  v("counts", counts);
  v("user_control", summary.user_control);
}

template <class V>
void describe(V& v, const SampledProfile& profile) {
  v("samples", profile.samples);
  v("summary", summarize(profile.samples));
  v.unless_empty("unmodelled", profile.scenario.dds.unmodelled);
  v("profile", model::config::effective_json(profile.scenario));
}

nlohmann::ordered_json to_json(const Sampling& sampling) {
  JsonObject v;
  v("scenario", sampling.name);
  v("seed", sampling.first_seed);
  v("wanted", sampling.wanted);
  describe(v, sampling.profiles.front());
  if (sampling.profiles.size() > 1) {
    nlohmann::ordered_json others = nlohmann::ordered_json::array();
    for (const SampledProfile& profile : sampling.profiles) {
      JsonObject other;
      other("profile_name", profile.name);
      describe(other, profile);
      others.push_back(std::move(other).take());
    }
    v("compare", others);
  }
  return std::move(v).take();
}

}  // namespace stormproof::report
