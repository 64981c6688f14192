// A pool of reusable slots with stable addresses: what is taken out of it stays where it is while
// others come and go. Its memory is bounded by the most slots that were ever in use at once.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace stormproof::model {

template <class T>
class SlotPool {
 public:
  /// Number of a slot that nobody uses; its content is what its last user left.
  std::uint32_t take() {
    if (free_.empty()) {
      const auto first = static_cast<std::uint32_t>(chunks_.size()) * chunk_size;
      chunks_.push_back(std::make_unique<Chunk>());
      for (std::uint32_t k = chunk_size; k-- > 0;) free_.push_back(first + k);
    }
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    return slot;
  }
  void give_back(std::uint32_t slot) { free_.push_back(slot); }

  T& operator[](std::uint32_t slot) { return (*chunks_[slot / chunk_size])[slot % chunk_size]; }
  const T& operator[](std::uint32_t slot) const {
    return (*chunks_[slot / chunk_size])[slot % chunk_size];
  }

 private:
  static constexpr std::uint32_t chunk_size = 256;
  using Chunk = std::array<T, chunk_size>;

  std::vector<std::unique_ptr<Chunk>> chunks_;
  std::vector<std::uint32_t> free_;
};

}  // namespace stormproof::model
