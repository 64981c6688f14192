// Printing of nanoseconds without any loss.
#include "checker/counterexample/time_text.hpp"

#include <fmt/format.h>

namespace stormproof::counterexample {

std::string milliseconds(model::Nanoseconds time) {
  return fmt::format("{}.{:06}", time.count() / 1'000'000, time.count() % 1'000'000);
}

std::string exact_time(model::Nanoseconds time) {
  struct Unit {
    std::int64_t size;
    int digits;
    const char* name;
  };
  for (const Unit unit :
       {Unit{1'000'000'000, 9, "s"}, Unit{1'000'000, 6, "ms"}, Unit{1'000, 3, "µs"}}) {
    if (time.count() < unit.size) continue;
    std::string text = fmt::format("{}", time.count() / unit.size);
    if (const std::int64_t rest = time.count() % unit.size; rest != 0) {
      text += fmt::format(".{:0{}}", rest, unit.digits);
      text.erase(text.find_last_not_of('0') + 1);
    }
    return fmt::format("{} {}", text, unit.name);
  }
  return fmt::format("{} ns", time.count());
}

}  // namespace stormproof::counterexample
