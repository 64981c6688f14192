// Numbers are absolute, durations relative.
#include "checker/cli/durations.hpp"

#include <limits>

#include <fmt/core.h>

#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

using model::Nanoseconds;
using model::config::Result;

namespace {

/// "24h" and "5min" in seconds; any other text as it is.
std::string in_seconds(const std::string& text) {
  for (const auto& [unit, seconds] : {std::pair{std::string_view{"min"}, 60}, {"h", 3'600}}) {
    if (!text.ends_with(unit)) continue;
    const auto count = model::config::parse_count(text.substr(0, text.size() - unit.size()));
    if (count && *count <= std::numeric_limits<std::int64_t>::max() / seconds) {
      return fmt::format("{}s", *count * seconds);
    }
  }
  return text;
}

}  // namespace

Result<Nanoseconds, std::string> parse_duration(const std::string& option, const std::string& text,
                                                Nanoseconds most) {
  const std::string expected =
      fmt::format("expected a duration from 0 to {}s, such as 20ms", most.count() / 1'000'000'000);
  const auto duration = model::config::parse_duration(in_seconds(text));
  if (!duration) return fmt::format("{}: {}; {}", option, duration.error(), expected);
  if (*duration > most) return fmt::format("{}: '{}' is too long; {}", option, text, expected);
  return *duration;
}

Result<Nanoseconds, std::string> parse_positive_duration(const std::string& option,
                                                         const std::string& text,
                                                         Nanoseconds most) {
  auto duration = parse_duration(option, text, most);
  if (duration && duration->count() == 0) {
    return fmt::format("{} {}: expected more than that", option, text);
  }
  return duration;
}

Result<std::pair<Nanoseconds, Nanoseconds>, std::string> parse_duration_range(
    const std::string& option, const std::string& text, Nanoseconds most) {
  constexpr std::string_view separator = "..";
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) {
    return fmt::format("{}: '{}' is no range; expected LO..HI, such as 0..60s", option, text);
  }
  const auto low = parse_duration(option, text.substr(0, at), most);
  if (!low) return low.error();
  const auto high = parse_duration(option, text.substr(at + separator.size()), most);
  if (!high) return high.error();
  if (*low > *high) {
    return fmt::format("{}: '{}' is empty; expected LO..HI with LO at most HI", option, text);
  }
  return std::pair{*low, *high};
}

Result<Nanoseconds, std::string> parse_start_jitter(const std::string& text,
                                                    const model::Scenario& scenario) {
  if (text.empty() && scenario.vary) return scenario.vary->start_jitter.value_or(Nanoseconds{});
  if (text.empty()) return Nanoseconds{};
  constexpr Nanoseconds longest{1'000'000'000'000};
  return parse_duration("--start-jitter", text, longest);
}

Result<std::int64_t, std::string> parse_until(const std::string& text, std::int64_t first_ns) {
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
