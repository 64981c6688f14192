// What the states mean that have a letter for a name: the paper's view of one descriptor towards
// one reader. The machines have the letters; pictures, charts and the guide take the words from
// here.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace stormproof::fsm {

struct StateWords {
  std::string_view state;  ///< as the reflection names it: "Q"
  std::string_view words;  ///< "queued for repair"
};

/// In the order of a repair.
[[nodiscard]] std::span<const StateWords> state_words();

/// "queued for repair" for "Q"; empty for a state whose name is a word already.
[[nodiscard]] std::string_view words_of_state(std::string_view state);

/// "U unacknowledged, R requested, …".
[[nodiscard]] std::string state_legend();

}  // namespace stormproof::fsm
