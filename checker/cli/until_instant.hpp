// `--until INSTANT` of the commands that read captures: where a capture is cut.
#pragma once

#include <cstdint>
#include <string>

#include "model/config/tree/result.hpp"

namespace stormproof::cli {

/// The instant in ns since 1970: INT64_MAX if `text` is empty. `text` is such a number, or a
/// duration after the first packet; otherwise the error says what was expected.
[[nodiscard]] model::config::Result<std::int64_t, std::string> parse_until(const std::string& text,
                                                                           std::int64_t first_ns);

}  // namespace stormproof::cli
