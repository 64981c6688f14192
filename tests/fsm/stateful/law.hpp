// The law of a stateful test: after every sequence of possible calls, what is under test and the
// model show the same.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tests/fsm/stateful/reactor.hpp"

namespace stormproof::stateful {

/// How hard the law is tried. The seed is fixed: a test run means the same everywhere.
struct Effort {
  int sequences = 100;
  int longest = 100;  ///< calls in a sequence
  bool shrink = true;
};

/// Tries the law on random sequences of calls, each on a new object from `under_test`. Returns the
/// shortest sequence found on which it shows something else than the subject's model, in words; or
/// nothing.
[[nodiscard]] std::optional<std::string> broken_on(
    const Subject& subject, const std::function<std::unique_ptr<Reactor>()>& under_test,
    const Effort& effort);

}  // namespace stormproof::stateful
