// A first-in, first-out queue in chunks of memory. The lanes of the event queue and the waiting
// fragments of a stage are such queues; their length changes by millions in one run, so they must
// neither allocate per element (as a list would), nor move what they hold when they grow (as a ring
// would), nor keep chunks of elements that have left.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>

namespace stormproof::model {

template <class T>
class ChunkQueue {
 public:
  ChunkQueue() = default;
  ChunkQueue(ChunkQueue&&) noexcept = default;
  ChunkQueue& operator=(ChunkQueue&&) = delete;
  ~ChunkQueue() {
    while (first_) first_ = std::move(first_->next);  // one after the other, not as a recursion
  }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T& front() const { return first_->elements[begin_]; }
  [[nodiscard]] T& front() { return first_->elements[begin_]; }

  /// Adds an element, to be filled in by its members: one that is put together elsewhere and copied
  /// at once makes the processor wait until the parts are written.
  [[nodiscard]] T& push_back() {
    if (end_ == chunk_size) grow();
    ++size_;
    return last_->elements[end_++];
  }

  void pop_front() {
    assert(!empty());
    if (--size_ == 0) {
      begin_ = end_ = 0;  // who comes and goes stays in the same memory
    } else if (++begin_ == chunk_size) {
      leave_first();
    }
  }

 private:
  static constexpr std::size_t chunk_size = 4096 / sizeof(T);
  struct Chunk {
    T elements[chunk_size];
    std::unique_ptr<Chunk> next;
  };

  void grow() {
    auto chunk = spare_ ? std::move(spare_) : std::make_unique_for_overwrite<Chunk>();
    Chunk* const added = chunk.get();
    (last_ != nullptr ? last_->next : first_) = std::move(chunk);
    last_ = added;
    end_ = 0;
  }

  /// The chunk that is kept spares those who come and go an allocation.
  void leave_first() {
    begin_ = 0;
    spare_ = std::exchange(first_, std::move(first_->next));
  }

  std::unique_ptr<Chunk> first_;
  Chunk* last_ = nullptr;
  std::size_t begin_ = 0;         // in the first chunk
  std::size_t end_ = chunk_size;  // in the last chunk
  std::size_t size_ = 0;
  std::unique_ptr<Chunk> spare_;
};

}  // namespace stormproof::model
