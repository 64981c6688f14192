// How the outcome of runs looks in reports.
#pragma once

#include "checker/engines/exact/health.hpp"
#include "checker/presentation/document/document.hpp"

namespace stormproof::report {

[[nodiscard]] inline Tone tone_of(exact::Health health) {
  switch (health) {
    case exact::Health::fine:
      return Tone::good;
    case exact::Health::slow_link:
    case exact::Health::waiting:
    case exact::Health::incomplete:
      return Tone::warn;
    case exact::Health::storm:
      return Tone::bad;
  }
  return Tone::plain;
}

/// What a storm is, where the document says that there is one.
inline void add_definition(Blocks& blocks, bool is_storm,
                           const std::optional<model::Limits>& limits) {
  if (is_storm) blocks.emplace_back(Paragraph{exact::storm_definition(limits)});
}

}  // namespace stormproof::report
