// The JSON form of sampled runs.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::report {

namespace {

using Json = nlohmann::ordered_json;
using sampling::Quantiles;
using sampling::Sample;

Json quantiles_json(const Quantiles& q) {
  const auto value = [](const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); };
  return {{"median", value(q.median)},
          {"p10", value(q.p10)},
          {"p90", value(q.p90)},
          {"min", value(q.min)},
          {"max", value(q.max)}};
}

Json summary_json(const SampleSummary& summary) {
  Json counts;
  const auto entries = model::Counts{}.entries();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    counts[entries[k].name] = quantiles_json(summary.counts[k]);
  }
  counts["total"] = quantiles_json(summary.total);
  const auto runs = static_cast<double>(std::max<std::size_t>(summary.runs, 1));
  return {{"runs", summary.runs},
          {"completed", summary.completed},
          {"completed_share", static_cast<double>(summary.completed) / runs},
          {"t_disc_ns", quantiles_json(summary.discovery_time_ns)},
          {"counts", counts},
          {"user_control", quantiles_json(summary.user_control)}};
}

Json sample_json(const Sample& sample) {
  Json counts;
  for (const auto& [name, value] : sample.counts.entries()) counts[name] = value;
  counts["total"] = sample.counts.total();
  counts["user_control"] = sample.user_control;
  return {
      {"seed", sample.seed},
      {"completed", sample.discovery_time.has_value()},
      {"end", name_of(sample.end)},
      {"t_disc_ns", sample.discovery_time ? Json(sample.discovery_time->count()) : Json(nullptr)},
      {"counts", counts},
      {"user_control", sample.user_control},
      {"events", sample.events}};
}

void add_profile(Json& json, const SampledProfile& profile) {
  Json samples = Json::array();
  for (const Sample& sample : profile.samples) samples.push_back(sample_json(sample));
  json["samples"] = samples;
  json["summary"] = summary_json(summarize(profile.samples));
  add_unmodelled(json, profile.scenario.dds);
  json["profile"] = model::config::effective_json(profile.scenario);
}

}  // namespace

Json to_json(const Sampling& sampling) {
  Json json;
  json["scenario"] = sampling.name;
  json["seed"] = sampling.first_seed;
  json["wanted"] = sampling.wanted;
  json["command"] = sampling.command;
  add_profile(json, sampling.profiles.front());
  if (sampling.profiles.size() == 1) return json;
  Json others = Json::array();
  for (const SampledProfile& profile : sampling.profiles) {
    Json other;
    other["profile_name"] = profile.name;
    add_profile(other, profile);
    others.push_back(other);
  }
  json["compare"] = others;
  return json;
}

}  // namespace stormproof::report
