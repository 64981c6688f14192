// Scopes in words.
#include "checker/engines/explorer/scope.hpp"

#include <fmt/core.h>

#include "props/monitors/describe.hpp"

namespace stormproof::explorer {

using props::time_text;

std::string to_text(const Scope& scope) {
  const std::string delays = scope.least_delay == scope.largest_delay
                                 ? "of " + time_text(scope.largest_delay)
                                 : fmt::format("in [{}, {}]", time_text(scope.least_delay),
                                               time_text(scope.largest_delay));
  std::string text = fmt::format(
      "D = {}, packet delays {}, {} loss{}, {}", scope.descriptors, delays,
      scope.losses == 0 ? "no" : fmt::format("at most {}", scope.losses),
      scope.losses > 1 ? "es" : "", scope.fifo ? "FIFO per source" : "any interleaving");
  if (scope.pushed > 0) text += fmt::format(", {} created after the match", scope.pushed);
  if (scope.leaves_within.count() > 0) {
    text += fmt::format(", repairs leave within {}", time_text(scope.leaves_within));
  }
  if (scope.side_by_side) text += ", the two sides open apart";
  if (scope.writers > 1) text += ", two writers";
  if (scope.readers > 1) text += fmt::format(", {} readers", scope.readers);
  if (scope.joins_within.count() > 0) {
    text += fmt::format(", the last of them joins within {}", time_text(scope.joins_within));
  }
  return text;
}

std::string relation_text(const Scope& scope, unsigned relation) {
  const std::string writer =
      std::string{name_of(model::streams[relation % scope.writers])} + " writer";
  const std::string reader = fmt::format("reader {}", relation / scope.writers);
  if (scope.writers == 1) return reader;
  return scope.readers == 1 ? writer : writer + ", " + reader;
}

std::string short_text(const Scope& scope) {
  std::string text = fmt::format("D = {}, k = {}", scope.descriptors, scope.losses);
  if (scope.pushed > 0) text += fmt::format(", {} created later", scope.pushed);
  if (scope.side_by_side) text += ", opening apart";
  if (scope.readers == 1 && scope.writers == 1) return text;
  if (scope.writers > 1) text += ", two writers";
  if (scope.readers > 1) text += fmt::format(", {} readers", scope.readers);
  if (scope.joins_within.count() > 0) text += ", one joining later";
  if (scope.least_delay == scope.largest_delay) {
    text += fmt::format(", each packet {}", time_text(scope.largest_delay));
  }
  return text;
}

}  // namespace stormproof::explorer
