// In how many files a knob of the DDS profile is named: its member, its row in the table of knobs,
// the tag with which rules ask for it, and what its vendor says of it. Whatever else names it has
// to be changed with it.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tests/structure/includes.hpp"

namespace stormproof::structure {

/// The keys of a table of knobs: what `visit.knob("key", …` says.
[[nodiscard]] std::vector<std::string> knobs_of(const std::string& table);

/// No knob is named in more than `usual` of the files, but for the listed ones, which are named in
/// as many as they are listed with; comments do not count.
[[nodiscard]] std::vector<std::string> check_knobs(
    const std::vector<std::string>& knobs, const Texts& texts, std::size_t usual,
    const std::map<std::string, std::size_t>& listed);

}  // namespace stormproof::structure
