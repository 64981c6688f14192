// The JSON of what runs were like; the same keys in every verb (specs/guide/output.md).
#pragma once

#include "checker/engines/exact/health.hpp"
#include "checker/presentation/json/describe.hpp"

namespace stormproof::exact {

template <class V>
void describe(V& v, const RunHealth& run) {
  v("health", run.health);
  v("t_disc_ns", run.completion);
  v("last_start_ns", run.last_start);
  v("since_last_start_ns", run.took);
  v("airtime_ratio", run.airtime);
  v("closed_to_open_loop", run.stretch);
  v("busy_share", run.busy);
  v("missing", run.missing);
}

template <class V>
void describe(V& v, const Outlook& outlook) {
  v("health", outlook.health());
  v("summary", outlook.headline() + ": " + outlook.sentence());
  v("runs", outlook.size());
  v("completed", outlook.completed());
  v("median", outlook.median());
  v("best", outlook.best());
  v("worst", outlook.worst());
}

}  // namespace stormproof::exact
