// The settings of the real system that the model has not got. A run says nothing about what they
// do, so every report of a run names them as what it assumes to make no difference: the same words
// in every report.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "model/dds_profile.hpp"

namespace stormproof::report {

/// What an entry of `DdsProfile::unmodelled` means for a result, for a heading.
inline constexpr const char* unmodelled_heading = "Not in the model, assumed to make no difference";

/// One line without a line feed, "not in the model: A, B and 3 more", for a terminal beside a
/// machine-readable output; empty if there is nothing.
[[nodiscard]] std::string unmodelled_line(const model::DdsProfile& dds);

/// Setting → what it would do.
[[nodiscard]] nlohmann::ordered_json unmodelled_json(const model::DdsProfile& dds);

/// Puts `unmodelled` into the report unless it is empty.
void add_unmodelled(nlohmann::ordered_json& report, const model::DdsProfile& dds);

}  // namespace stormproof::report
