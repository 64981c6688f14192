// The paper's figures of a capture by name, counted twice: from the events of the project's parser
// by its own counting, and from tshark's dissection in another way. Names of figures that are zero
// are left out.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "checker/evidence/capture/events.hpp"
#include "tests/checker/evidence/capture/dissection.hpp"

namespace stormproof::capture::testing {

using Figures = std::map<std::string, std::uint64_t>;

[[nodiscard]] Figures figures_of(const Conversation& conversation);
[[nodiscard]] Figures figures_of(const Dissection& dissection);

}  // namespace stormproof::capture::testing
