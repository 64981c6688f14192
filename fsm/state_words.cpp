// The one table of letters and their words.
#include "fsm/state_words.hpp"

#include <array>

namespace stormproof::fsm {

namespace {

constexpr std::array<StateWords, 5> words{{{"U", "unacknowledged"},
                                           {"R", "requested"},
                                           {"Q", "queued for repair"},
                                           {"S", "sent and suppressed"},
                                           {"A", "acknowledged"}}};

}  // namespace

std::span<const StateWords> state_words() { return words; }

std::string_view words_of_state(std::string_view state) {
  for (const StateWords& one : words) {
    if (one.state == state) return one.words;
  }
  return {};
}

std::string state_legend() {
  std::string text;
  for (const StateWords& one : words) {
    text += (text.empty() ? "" : ", ") + std::string{one.state} + " " + std::string{one.words};
  }
  return text;
}

}  // namespace stormproof::fsm
