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

/// With the HEARTBEATs and ACKNACKs that are in no class.
struct AllCounts {
  const Counts& counts;
  std::uint64_t user_control = 0;
};

template <class V>
void describe(V& v, const AllCounts& all) {
  describe(v, all.counts);
  v("user_control", all.user_control);
}

}  // namespace stormproof::model
