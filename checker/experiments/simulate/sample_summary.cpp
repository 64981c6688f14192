// Statistics of sampled runs.
#include "checker/experiments/simulate/sample_report.hpp"

namespace stormproof::report {

namespace {

using sampling::Sample;

template <class Value>
sampling::Quantiles quantiles_of(const std::vector<Sample>& samples, Value&& value) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample& sample : samples) values.push_back(static_cast<double>(value(sample)));
  return sampling::quantiles(std::move(values));
}

}  // namespace

SampleSummary summarize(const std::vector<Sample>& samples) {
  SampleSummary summary;
  summary.runs = samples.size();
  std::vector<double> times;
  for (const Sample& sample : samples) {
    if (sample.discovery_time) times.push_back(static_cast<double>(sample.discovery_time->count()));
  }
  summary.completed = times.size();
  summary.discovery_time_ns = sampling::quantiles(times, samples.size() - times.size());
  for (std::size_t k = 0; k < summary.counts.size(); ++k) {
    summary.counts[k] =
        quantiles_of(samples, [k](const Sample& s) { return s.counts.entries()[k].value; });
  }
  summary.total = quantiles_of(samples, [](const Sample& s) { return s.counts.total(); });
  summary.user_control = quantiles_of(samples, [](const Sample& s) { return s.user_control; });
  return summary;
}

}  // namespace stormproof::report
