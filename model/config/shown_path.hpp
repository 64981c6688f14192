// How reports name a file. A report is shared: what is found by name in a folder of specs is shown
// below "specs", wherever that folder lies on this machine. Other paths are shown as they were
// given.
#pragma once

#include <string>

#include "model/config/tree/tree.hpp"

namespace stormproof::model::config {

/// "specs/dds/paper.yaml" for a file in one of `SpecPath::standard()`'s folders.
[[nodiscard]] std::string shown_path(const std::string& file);

/// `Place::to_string` with the file as it is shown.
[[nodiscard]] std::string shown_place(const Place& place);

}  // namespace stormproof::model::config
