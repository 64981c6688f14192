// Durations, ranges and instants that options take. Errors are sentences that name the option.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"
#include "model/units.hpp"

namespace stormproof::cli {

/// "20ms": from 0 to `most`.
[[nodiscard]] model::config::Result<model::Nanoseconds, std::string> parse_duration(
    const std::string& option, const std::string& text, model::Nanoseconds most);

/// The same, but more than nothing.
[[nodiscard]] model::config::Result<model::Nanoseconds, std::string> parse_positive_duration(
    const std::string& option, const std::string& text, model::Nanoseconds most);

/// "LO..HI", both from 0 to `most` and in ascending order.
[[nodiscard]] model::config::Result<std::pair<model::Nanoseconds, model::Nanoseconds>, std::string>
parse_duration_range(const std::string& option, const std::string& text, model::Nanoseconds most);

/// `--start-jitter`: up to 1000 s; if `text` is empty, that of the scenario's `vary`, or none.
[[nodiscard]] model::config::Result<model::Nanoseconds, std::string> parse_start_jitter(
    const std::string& text, const model::Scenario& scenario);

/// `--until INSTANT`, where a capture is cut, in ns since 1970: INT64_MAX if `text` is empty.
/// `text` is such a number, or a duration after the first packet; otherwise the error says what was
/// expected.
[[nodiscard]] model::config::Result<std::int64_t, std::string> parse_until(const std::string& text,
                                                                           std::int64_t first_ns);

}  // namespace stormproof::cli
