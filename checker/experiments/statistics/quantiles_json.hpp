// Order statistics in JSON: the same keys in all verbs.
#pragma once

#include "checker/experiments/statistics/quantiles.hpp"

namespace stormproof::statistics {

template <class V>
void describe(V& v, const Quantiles& quantiles) {
  v("median", quantiles.median);
  v("p10", quantiles.p10);
  v("p90", quantiles.p90);
  v("min", quantiles.min);
  v("max", quantiles.max);
}

}  // namespace stormproof::statistics
