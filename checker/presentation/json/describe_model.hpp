// What every verb says of the model's figures, as JSON: the vocabulary of `simulate`
// (specs/guide/output.md).
#pragma once

#include "model/counts.hpp"

namespace stormproof::model {

template <class V>
void describe(V& v, const Counts& counts) {
  for (const auto& [name, value] : counts.entries()) v(name, value);
  v("total", counts.total());
}

}  // namespace stormproof::model
