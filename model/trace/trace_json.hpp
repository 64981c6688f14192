// Recorded lines as JSON: parsing that survives hostile input, and the first place at which two
// lines differ.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace stormproof::model::trace {

using Json = nlohmann::ordered_json;

/// One JSON value, nested at most 32 deep; nothing if the text is anything else.
[[nodiscard]] std::optional<Json> parse_line(std::string_view text);

/// Where two values differ, and what stands there ("absent" if nothing does); long values are cut.
struct Mismatch {
  std::string key;  ///< "transitions.0.after"; empty: the whole value
  std::string recorded;
  std::string replayed;
};

/// The first difference in the order of the recorded keys, then of the replayed ones; nothing if
/// the values are equal. The order of keys and white space do not count.
[[nodiscard]] std::optional<Mismatch> first_difference(const Json& recorded, const Json& replayed);

}  // namespace stormproof::model::trace
