// The JSON of sampled runs and of their summary.
#pragma once

#include <algorithm>

#include "checker/engines/exact/health_json.hpp"
#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/presentation/json/describe_model.hpp"

namespace stormproof::trials {

template <class V>
void describe(V& v, const Sample& sample) {
  v("seed", sample.seed);
  v("completed", sample.discovery_time.has_value());
  v("end", sample.end);
  v("t_disc_ns", sample.discovery_time);
  v("counts", model::AllCounts{sample.counts, sample.user_control});
  v("user_control", sample.user_control);
  v("events", sample.events);
  v("health", sample.health.health);
  v("since_last_start_ns", sample.health.took);
}

}  // namespace stormproof::trials

namespace stormproof::report {

struct SummaryOfCounts {
  const SampleSummary& summary;
};

template <class V>
void describe(V& v, const SummaryOfCounts& counts) {
  const auto entries = model::Counts{}.entries();
  for (std::size_t k = 0; k < entries.size(); ++k) v(entries[k].name, counts.summary.counts[k]);
  v.unless_empty("lookup", counts.summary.lookup.max.value_or(0) > 0
                               ? std::optional{counts.summary.lookup}
                               : std::nullopt);
  v("total", counts.summary.total);
}

template <class V>
void describe(V& v, const SampleSummary& summary) {
  const auto runs = static_cast<double>(std::max<std::size_t>(summary.runs, 1));
  v("runs", summary.runs);
  v("completed", summary.completed);
  v("completed_share", static_cast<double>(summary.completed) / runs);
  v("t_disc_ns", summary.discovery_time_ns);
  v("counts", SummaryOfCounts{summary});
  v("user_control", summary.user_control);
}

}  // namespace stormproof::report
