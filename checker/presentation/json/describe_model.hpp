// What every verb says of the model's figures, as JSON: the vocabulary of `simulate`
// (specs/guide/output.md).
#pragma once

#include <optional>

#include "model/counts.hpp"

namespace stormproof::model {

template <class V>
void describe(V& v, const Counts& counts) {
  for (const auto& [name, value] : counts.entries()) v(name, value);
  const auto of_server = [&](std::uint64_t value) {
    return counts.of_server() > 0 ? std::optional{value} : std::nullopt;
  };
  v.unless_empty("pdp_data", of_server(counts.pdp_data));
  v.unless_empty("pdp_heartbeat", of_server(counts.pdp_heartbeat));
  v.unless_empty("pdp_acknack", of_server(counts.pdp_acknack));
  v.unless_empty("gap", of_server(counts.gap));
  v.unless_empty("lookup", counts.lookup > 0 ? std::optional{counts.lookup} : std::nullopt);
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
