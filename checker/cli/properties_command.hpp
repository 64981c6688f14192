// `stormproof properties`: the catalogue.
#pragma once

namespace stormproof::cli {

/// Prints every property with its statements, assumptions, engines and source.
[[nodiscard]] int properties(bool json);

}  // namespace stormproof::cli
