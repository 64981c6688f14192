// Printing of nanoseconds without any loss.
#include "checker/verification/counterexample/time_text.hpp"

#include <fmt/format.h>

namespace stormproof::counterexample {

std::string milliseconds(model::Nanoseconds time) {
  return fmt::format("{}.{:06}", time.count() / 1'000'000, time.count() % 1'000'000);
}

}  // namespace stormproof::counterexample
