// A first-in, first-out queue in one block of memory that doubles when it is full. The lanes of the event queue
// and the waiting fragments of a stage are such queues; their length changes by millions in one run, so they
// must neither allocate per element (as a list would) nor keep blocks of elements that have left.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace stormproof::model {

template <class T>
class RingBuffer {
 public:
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T& front() const { return slots_[first_]; }
  [[nodiscard]] const T& back() const { return slots_[(first_ + size_ - 1) & mask()]; }

  void push_back(const T& value) {
    if (size_ == slots_.size()) grow();
    slots_[(first_ + size_) & mask()] = value;
    ++size_;
  }

  void pop_front() {
    assert(!empty());
    first_ = (first_ + 1) & mask();
    --size_;
  }

 private:
  [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }

  void grow() {
    std::vector<T> larger(slots_.empty() ? 16 : 2 * slots_.size());
    for (std::size_t k = 0; k < size_; ++k) larger[k] = slots_[(first_ + k) & mask()];
    slots_.swap(larger);
    first_ = 0;
  }

  std::vector<T> slots_;  // its size is a power of two
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace stormproof::model
