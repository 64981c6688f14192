// What standard output can show.
#pragma once

#include "checker/presentation/document/render.hpp"

namespace stormproof::cli {

/// On a terminal its width and, unless NO_COLOR is set (no-color.org), colours; otherwise the
/// defaults.
[[nodiscard]] report::Terminal standard_output();

}  // namespace stormproof::cli
