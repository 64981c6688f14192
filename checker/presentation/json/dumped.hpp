// How the program prints JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace stormproof::report {

/// Indented by two spaces, with a line feed at the end. What is not UTF-8 becomes U+FFFD.
[[nodiscard]] std::string dumped(const nlohmann::ordered_json& json);

}  // namespace stormproof::report
