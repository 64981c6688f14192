// A first-in, first-out queue in one block of memory that doubles when it is full. The lanes of the
// event queue and the waiting fragments of a stage are such queues; their length changes by
// millions in one run, so they must neither allocate per element (as a list would) nor keep blocks
// of elements that have left.
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>

namespace stormproof::model {

template <class T>
class RingBuffer {
 public:
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T& front() const { return slots_[first_]; }
  [[nodiscard]] const T& back() const { return slots_[(first_ + size_ - 1) & mask_]; }

  void push_back(const T& value) {
    if (!slots_ || size_ > mask_) grow();
    slots_[(first_ + size_) & mask_] = value;
    ++size_;
  }

  void pop_front() {
    assert(!empty());
    first_ = (first_ + 1) & mask_;
    --size_;
  }

 private:
  void grow() {
    const std::size_t capacity = slots_ ? 2 * (mask_ + 1) : 16;
    auto larger = std::make_unique<T[]>(capacity);
    for (std::size_t k = 0; k < size_; ++k) larger[k] = slots_[(first_ + k) & mask_];
    slots_ = std::move(larger);
    mask_ = capacity - 1;
    first_ = 0;
  }

  std::unique_ptr<T[]> slots_;
  std::size_t mask_ = 0;  // the capacity is a power of two
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace stormproof::model
