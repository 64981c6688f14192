// How the counts grow: the messages of each class in equal steps of time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::capture {

struct Timeline {
  std::int64_t step_ns = 1;
  /// For each step, the messages of each class in it.
  std::vector<std::array<std::uint64_t, message_class_count>> steps{};
};

/// `steps` equal steps that cover first_ns … end_ns; fewer if a step would be below 1 ns.
[[nodiscard]] Timeline timeline(const Conversation& conversation, const Counting& counting,
                                std::int64_t end_ns, std::size_t steps);

}  // namespace stormproof::capture
