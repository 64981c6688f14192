// Statistics of sampled runs.
#include <algorithm>

#include "checker/experiments/simulate/sample_report.hpp"

namespace stormproof::report {

namespace {

using trials::Sample;

template <class Value>
statistics::Quantiles quantiles_of(const std::vector<Sample>& samples, Value&& value) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample& sample : samples) values.push_back(static_cast<double>(value(sample)));
  return statistics::quantiles(std::move(values));
}

}  // namespace

SampleSummary summarize(const std::vector<Sample>& samples) {
  SampleSummary summary;
  summary.runs = samples.size();
  summary.completed = static_cast<std::size_t>(std::ranges::count_if(
      samples, [](const Sample& sample) { return sample.discovery_time.has_value(); }));
  summary.discovery_time_ns = quantiles_of(
      samples, [](const Sample& s) { return statistics::completion_ns(s.discovery_time); });
  for (const model::MessageClass one : model::message_classes) {
    summary.counts[model::index_of(one)] =
        quantiles_of(samples, [one](const Sample& s) { return s.counts[one]; });
  }
  summary.total = quantiles_of(samples, [](const Sample& s) { return s.counts.total(); });
  summary.user_control = quantiles_of(samples, [](const Sample& s) { return s.user_control; });
  summary.lookup = quantiles_of(samples, [](const Sample& s) { return s.counts.lookup; });
  return summary;
}

}  // namespace stormproof::report
