// What a flag or a number is before anything has happened: 0, unless it says that it is true of
// what exists from the start.
#pragma once

#include <cstdint>

namespace stormproof::fsm::composition {

template <class V>
[[nodiscard]] constexpr std::int64_t first_value() {
  if constexpr (requires { V::from_the_start; }) return V::from_the_start ? 1 : 0;
  return 0;
}

}  // namespace stormproof::fsm::composition
