// The output formats, by the names that `--format` takes. CSV is for verbs that have tables of
// numbers; it is no rendering of the document.
#pragma once

#include <cstdint>

namespace stormproof::report {

enum class Format : std::uint8_t { text, json, markdown, github, html, junit, sarif, csv };

}  // namespace stormproof::report
