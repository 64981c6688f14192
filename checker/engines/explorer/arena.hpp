// Memory that only grows: runs of values behind each other, which stay where they are. A vector
// that doubles would copy hundreds of megabytes again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace stormproof::explorer {

template <class T>
class Arena {
 public:
  /// Room for `count` values, at most `chunk`.
  T* allocate(std::size_t count) {
    if (chunks_.empty() || used_ + count > chunk) {
      // A page that is never written costs nothing.
      chunks_.push_back(std::make_unique_for_overwrite<T[]>(chunk));
      used_ = 0;
    }
    T* const room = chunks_.back().get() + used_;
    used_ += count;
    allocated_ += count;
    return room;
  }
  [[nodiscard]] std::size_t bytes() const { return allocated_ * sizeof(T); }

 private:
  static constexpr std::size_t chunk = std::size_t{1} << 16;
  std::vector<std::unique_ptr<T[]>> chunks_;
  std::size_t used_ = 0;       // of the last chunk
  std::size_t allocated_ = 0;  // in all
};

}  // namespace stormproof::explorer
