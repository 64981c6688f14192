// The JSON form of sampled runs.
#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/experiments/simulate/samples_json.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::report {

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
  v("start_jitter_ns", sampling.start_jitter);
  v("outlook", trials::outlook_of(sampling.profiles.front().samples));
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
