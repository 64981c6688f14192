// What a message was is often open: an answer, or what a timer sent. All ways to tell are followed
// at once, and of those that are alike the best.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace stormproof::conform {

/// Without those that another one is as good as: what they allow, it allows.
template <class Way>
[[nodiscard]] std::vector<Way> best(std::vector<Way> ways) {
  std::vector<Way> kept;
  for (Way& way : ways) {
    const auto is_as_good = [&](const Way& other) { return other.is_as_good_as(way); };
    if (std::ranges::any_of(kept, is_as_good)) continue;
    std::erase_if(kept, [&](const Way& other) { return way.is_as_good_as(other); });
    kept.push_back(std::move(way));
  }
  return kept;
}

/// One way to tell a writer's answers to ACKNACKs from what its timer sent; vendors add what else
/// the timer goes by.
struct Telling {
  std::int64_t next_ns = INT64_MIN;     ///< when the timer can send again
  std::vector<std::size_t> answered{};  ///< ACKNACKs, by relation

  [[nodiscard]] bool is_as_good_as(const Telling& other) const {
    return next_ns <= other.next_ns &&
           std::ranges::equal(answered, other.answered, std::less_equal{});
  }
};
/// One to reader r answers an ACKNACK, of which `asked` can have arrived: whether some way has one
/// left.
template <class Way>
bool answer(const std::vector<Way>& ways, std::size_t r, std::size_t asked,
            std::vector<Way>& next) {
  for (const Way& way : ways) {
    if (way.answered[r] >= asked) continue;
    next.push_back(way);
    ++next.back().answered[r];
  }
  return !next.empty();
}
/// When the timer of some way can send again.
template <class Way>
[[nodiscard]] std::int64_t earliest(const std::vector<Way>& ways) {
  return std::ranges::min(ways, {}, &Way::next_ns).next_ns;
}

}  // namespace stormproof::conform
