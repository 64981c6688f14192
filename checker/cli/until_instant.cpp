// Numbers are absolute, durations relative.
#include "checker/cli/until_instant.hpp"

#include <limits>

#include <fmt/core.h>

#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

model::config::Result<std::int64_t, std::string> parse_until(const std::string& text,
                                                             std::int64_t first_ns) {
  constexpr auto always = std::numeric_limits<std::int64_t>::max();
  if (text.empty()) return always;
  constexpr const char* expected =
      "expected nanoseconds since 1970, or a duration after the first packet such as 3s";
  if (const auto absolute = model::config::parse_count(text)) {
    if (*absolute >= first_ns) return *absolute;
    return fmt::format("--until {}: before the first packet ({}); {}", text, first_ns, expected);
  }
  const auto duration = model::config::parse_duration(text);
  if (!duration || duration->count() < 0) {
    return fmt::format("--until '{}': {}", text, expected);
  }
  return duration->count() > always - first_ns ? always : first_ns + duration->count();
}

}  // namespace stormproof::cli
