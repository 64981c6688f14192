// Scopes in words.
#include "checker/explorer/scope.hpp"

#include <fmt/format.h>

namespace stormproof::explorer {

std::string duration_text(model::Nanoseconds time) {
  const std::int64_t ns = time.count();
  if (ns == 0) return "0";
  if (ns % 1'000'000'000 == 0) return fmt::format("{} s", ns / 1'000'000'000);
  if (ns % 1'000'000 == 0) return fmt::format("{} ms", ns / 1'000'000);
  if (ns % 1'000 == 0) return fmt::format("{} us", ns / 1'000);
  return fmt::format("{} ns", ns);
}

std::string to_text(const Scope& scope) {
  const std::string delays = scope.least_delay == scope.largest_delay
                                 ? "of " + duration_text(scope.largest_delay)
                                 : fmt::format("in [{}, {}]", duration_text(scope.least_delay),
                                               duration_text(scope.largest_delay));
  std::string text = fmt::format(
      "D = {}, packet delays {}, {} loss{}, {}", scope.descriptors, delays,
      scope.losses == 0 ? "no" : fmt::format("at most {}", scope.losses),
      scope.losses > 1 ? "es" : "", scope.fifo ? "FIFO per source" : "any interleaving");
  if (scope.pushed > 0) text += fmt::format(", {} created after the match", scope.pushed);
  if (scope.leaves_within.count() > 0) {
    text += fmt::format(", repairs leave within {}", duration_text(scope.leaves_within));
  }
  if (scope.side_by_side) text += ", the two sides open apart";
  return text;
}

std::string short_text(const Scope& scope) {
  std::string text = fmt::format("D = {}, k = {}", scope.descriptors, scope.losses);
  if (scope.pushed > 0) text += fmt::format(", {} created later", scope.pushed);
  if (scope.side_by_side) text += ", opening apart";
  return text;
}

}  // namespace stormproof::explorer
