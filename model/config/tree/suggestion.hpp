// "did you mean …": the nearest of the names that would have been right. A misspelt key is the most
// frequent mistake in a scenario file.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace stormproof::model::config {

/// "; did you mean 'name'?" for the candidate with the least edit distance to `word`, or "" if none
/// is near.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     std::span<const std::string> candidates);

}  // namespace stormproof::model::config
