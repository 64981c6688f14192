// The output formats of `check` and `diff`, by the names that `--format` takes.
#pragma once

#include <cstdint>

namespace stormproof::report {

enum class Format : std::uint8_t { text, json, markdown, html, junit, sarif };

}  // namespace stormproof::report
