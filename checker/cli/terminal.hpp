// What standard output and standard error can show.
#pragma once

#include <cstddef>
#include <optional>

#include "checker/presentation/document/render.hpp"

namespace stormproof::cli {

/// On a terminal its width and, unless NO_COLOR is set (no-color.org), colours; otherwise the
/// defaults.
[[nodiscard]] report::Terminal standard_output();

/// The columns of the terminal behind standard error; nothing if it is none.
[[nodiscard]] std::optional<std::size_t> columns_of_errors();

}  // namespace stormproof::cli
