// How many of the functions by which a world asks its host (model/engine/running_world.hpp) a host
// writes by hand. What follows from what its composition declares it has from a store
// (model/engine/stored.hpp); packets, opaque steps and what only it knows are left, and a host that
// grows back an accessor for each thing is noticed.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tests/structure/includes.hpp"

namespace stormproof::structure {

/// Declarations in a text, not calls: a name of the list in host_functions.cpp and its parenthesis,
/// with a type before it. Overloads count one by one, templates once; comments do not count.
[[nodiscard]] std::size_t count_host_functions(const std::string& text);

/// How many each host may have, by file.
using HostFunctions = std::map<std::string, std::size_t>;

/// No host has more; each of them exists and has some; and whoever has a store is in the list.
[[nodiscard]] std::vector<std::string> check_hosts(const Texts& texts, const HostFunctions& most);

}  // namespace stormproof::structure
