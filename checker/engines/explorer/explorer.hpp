// The engine "explorer": runs the concrete machines of one relation, of one writer with several
// readers, or of both writers of a participant, along every interleaving of a small scope, with
// event times as difference constraints, and reports what breaks first. Its counterexamples have
// the fewest possible events; each has been replayed by the simulator before it is reported; if
// that does not confirm it, explorer and simulator disagree, and the finding is disputed. What it
// does not find is bounded by the scopes that it has exhausted, which the finding states; without
// one it is inconclusive.
#pragma once

#include <span>
#include <string_view>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::explorer {

/// Answers about those of `properties` that are about one relation. Who asks for several readers is
/// told of both writers of a participant, too. Searches end after so many states that a check takes
/// about 5 s, several times that with several readers; an unfinished search says how far it came.
[[nodiscard]] checker::Findings check(std::span<const std::string_view> properties,
                                      const checker::CheckRequest& request);

/// What the explorer needs of a request; the solvers are none of its business.
struct Request {
  const model::Scenario& scenario;  ///< the specification
  const checker::Mutant* mutant = nullptr;
  std::function<bool(std::string_view)> on_progress;  ///< false interrupts
  /// 1: one relation only; 2 … most_readers: up to so many readers of one writer, too.
  unsigned readers = 1;
  unsigned effort = 1;  ///< multiplies the states that are looked at
  /// What the explored world does wrong and runs do not: for the test that notices it.
  model::Mutation misread = {};
  /// 2: both writers of a participant, too.
  unsigned writers = 1;
};
[[nodiscard]] checker::Findings explore(std::span<const std::string_view> properties,
                                        const Request& request);

}  // namespace stormproof::explorer
