// Files below the `specs` folders that are read apart from scenarios and profiles: grids of a
// sweep, policies of a comparison. They are given by name or by path, like everything else there.
#pragma once

#include <string>
#include <string_view>

#include "model/config/spec_path.hpp"

namespace stormproof::model::config {

/// The file that `reference` means: a path, or a name of this kind. An error lists a similar name;
/// `noun` ("grid") says what is missing.
[[nodiscard]] Result<std::string> find_named_file(const std::string& reference,
                                                  std::string_view noun, SpecKind kind,
                                                  const SpecPath& specs);

}  // namespace stormproof::model::config
