// The relevant events that a story or a chart has room for. The start shows how the relation opens,
// the end shows what breaks; of a long run the middle is left out.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "checker/verification/counterexample/history.hpp"
#include "checker/verification/counterexample/relevance.hpp"

namespace stormproof::counterexample {

/// An event that is shown, or a gap of events that are not.
struct Selected {
  bool gap = false;
  std::size_t step = 0;  ///< of a gap: its first event
  std::size_t last = 0;  ///< of a gap: its last event
};

/// At most `limit` (≥ 4) events with the gaps between them, in order; the violating one is the
/// last.
[[nodiscard]] std::vector<Selected> select(const History& history, const Relevance& relevance,
                                           std::size_t limit);

/// Without the middle of stretches that repeat themselves: events with the same shape one after the
/// other, or in turns of two or three. The first and the last turn stay; what lay between them is
/// a gap. `shape` says what an event is like, apart from its numbers.
[[nodiscard]] std::vector<Selected> without_repetition(
    const std::vector<Selected>& selected, const std::function<std::string(std::size_t)>& shape);

/// "34 events: 20 on the channel, 4 of SPDP, 10 of other relations".
[[nodiscard]] std::string gap_text(const History& history, const Relevance& relevance,
                                   const Selected& gap);

}  // namespace stormproof::counterexample
