// Printing of nanoseconds without any loss.
#include "checker/presentation/text/time_text.hpp"

#include <fmt/format.h>

namespace stormproof::report {

std::string milliseconds(model::Nanoseconds time) {
  return fmt::format("{}.{:06}", time.count() / 1'000'000, time.count() % 1'000'000);
}

}  // namespace stormproof::report
