// The JSON of what runs were like; the same keys in every verb (specs/guide/output.md).
#pragma once

#include "checker/engines/exact/health.hpp"
#include "checker/presentation/json/type.hpp"

namespace stormproof::exact {

struct MissingCount {
  std::uint64_t count = 0;
};

template <class V>
void describe(V& v, const MissingCount& missing) {
  v("count", missing.count);
}

template <class V>
void describe(V& v, const RunHealth& run) {
  v("health", run.health);
  v("t_disc_ns", run.completion);
  v("last_start_ns", run.last_start);
  v("since_last_start_ns", run.took);
  v("needless_ratio", run.needless);
  v("airtime_ratio", run.airtime);
  v("closed_to_open_loop", run.stretch);
  v("busy_share", run.busy);
  v("missing", MissingCount{run.missing});
}

template <class V>
void describe(V& v, const Outlook& outlook) {
  v("health", outlook.health());
  v("sentence", outlook.headline() + ": " + outlook.sentence());
  v("runs", outlook.size());
  v("completed", outlook.completed());
  v("median_run", outlook.median());
  v("best_run", outlook.best());
  v("worst_run", outlook.worst());
}

inline Outlook example_of(report::Type<Outlook>) { return Outlook{{RunHealth{}}}; }

}  // namespace stormproof::exact
