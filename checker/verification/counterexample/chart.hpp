// What a sequence chart of a counterexample shows: its relevant events, and the packets that they
// send and receive.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "checker/presentation/sequence/chart.hpp"
#include "props/verdict.hpp"

namespace stormproof::counterexample {

using sequence::Chart;
using sequence::mermaid_chart;
using sequence::svg_chart;

/// At most 40 events; of more relevant ones those in the middle are left out. `packets` (numbers)
/// are shown in any case, where a shown event sends or receives them.
[[nodiscard]] Chart chart_of(const props::Counterexample& counterexample,
                             std::span<const std::uint64_t> packets = {});

[[nodiscard]] std::string mermaid_chart(const props::Counterexample& counterexample);
[[nodiscard]] std::string svg_chart(const props::Counterexample& counterexample);

}  // namespace stormproof::counterexample
