// What a participant of Fast DDS announces has the sizes of its version (`dds.sizes`), and from 3.0
// on it says which version that is. A profile of another one is not what is captured, whatever else
// it explains: the messages of a small discovery are the same in many versions.
#pragma once

#include <cstddef>
#include <optional>

#include "checker/evidence/conform/context.hpp"

namespace stormproof::conform {

/// The first DATA(p) of participant i, if it is of another version than the profile's sizes.
[[nodiscard]] std::optional<Unexplained> other_version(const Context& its, std::size_t i);

}  // namespace stormproof::conform
