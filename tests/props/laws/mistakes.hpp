// Simulators with a mistake, one or more for each law: what the law has to notice.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "props/laws/law.hpp"

namespace stormproof::props {

struct Mistake {
  std::string_view law;  ///< that notices it
  std::string what;
  Simulate simulate;
};

[[nodiscard]] std::vector<Mistake> mistakes();

}  // namespace stormproof::props
