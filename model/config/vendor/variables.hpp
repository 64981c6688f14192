// Environment variables in a vendor's file. What a file means must not depend on who looks at it
// where, so a variable has the default that the file itself gives it, unless somebody asks for the
// environment (--from-environment).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/config/tree/quantities.hpp"

namespace stormproof::model::config::vendor {

/// From now on variables are looked up in the environment of the process. Once, before files are
/// read.
void take_variables_from_environment();

struct Expanded {
  std::string text;
  std::vector<std::string> variables{};  ///< that it names, in order
};

/// As Cyclone DDS 0.10 expands a value (ddsrt/src/expand_vars.c): ${X}, ${X:-default}, ${X:+other},
/// ${X:?message}, nested up to 20 deep; a variable that is empty counts as not set. What is wrong:
/// an expansion that does not end, another operator, ${X:?…} of what is not set, over 64 KB.
[[nodiscard]] Parsed<Expanded> expand_variables(std::string_view text);

}  // namespace stormproof::model::config::vendor
