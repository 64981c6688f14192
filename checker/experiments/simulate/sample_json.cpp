// The JSON form of sampled runs.
#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/experiments/simulate/samples_json.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/presentation/json/schema.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::report {

template <class V>
void describe(V& v, const SampledProfile& profile) {
  v("samples", profile.samples);
  v("summary", summarize(profile.samples));
  v.unless_empty("unmodelled", profile.scenario.dds.unmodelled);
  v.as_in("profile", "../scenario.schema.json", model::config::effective_json(profile.scenario));
}

namespace {

struct ComparedProfile {
  const SampledProfile& profile;
};

template <class V>
void describe(V& v, const ComparedProfile& compared) {
  v("profile_name", compared.profile.name);
  describe(v, compared.profile);
}

}  // namespace

static Sampling example_of(Type<Sampling>) {
  Sampling sampling;
  sampling.profiles.resize(1);
  return sampling;
}

template <class V>
void describe(V& v, const Sampling& sampling) {
  std::vector<ComparedProfile> compared;
  if (sampling.profiles.size() > 1) {
    for (const SampledProfile& profile : sampling.profiles) compared.push_back({profile});
  }
  v("scenario", sampling.name);
  v("seed", sampling.first_seed);
  v("wanted", sampling.wanted);
  v("start_jitter_ns", sampling.start_jitter);
  v("outlook", trials::outlook_of(sampling.profiles.front().samples));
  describe(v, sampling.profiles.front());
  v.unless_empty("compare", compared);
}

nlohmann::ordered_json to_json(const Sampling& sampling) { return json_of(sampling); }

nlohmann::ordered_json sampling_schema(SchemaDefinitions& definitions) {
  return schema_form<Sampling>(definitions);
}

}  // namespace stormproof::report
