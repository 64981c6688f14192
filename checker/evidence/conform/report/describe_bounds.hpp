// The bounds of a verdict as JSON, for every report that names them.
#pragma once

#include "checker/evidence/conform/bounds.hpp"

namespace stormproof::conform {

template <class V>
void describe(V& v, const Bounds& bounds) {
  v("least_delay_ns", bounds.least_delay_ns);
  v("most_delay_ns", bounds.most_delay_ns);
  v("most_send_lag_ns", bounds.most_send_lag_ns);
  v("most_lateness_ns", bounds.most_lateness_ns);
  v("most_clock_age_ns", bounds.most_clock_age_ns);
  v("most_same_host_ns", bounds.most_same_host_ns);
  v("most_queueing_ns", bounds.most_queueing_ns);
  v("clock_error_ns", bounds.clock_error_ns);
  v("may_lose", bounds.may_lose);
}

}  // namespace stormproof::conform
