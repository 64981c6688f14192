// What monitors remember of packets that are under way, by number. Packets of neighbouring numbers
// come and go at about the same time, so they share a page, and the table that finds the page of a
// number stays small.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "model/engine/slot_pool.hpp"

namespace stormproof::props {

template <class T>
class NumberMap {
 public:
  /// What is remembered of the number, or null. It stays where it is until it is removed.
  [[nodiscard]] T* find(std::uint64_t number) {
    if (slots_.empty()) return nullptr;
    const Slot& slot = slots_[place_of(number / page_size)];
    return (slot.members & bit(number)) != 0 ? &pages_[slot.page][number % page_size] : nullptr;
  }
  /// A place for what is remembered of a new number, with what somebody left there; null if there
  /// is something already. It is to be filled in by its members: one that is put together elsewhere
  /// and copied at once makes the processor wait until the parts are written.
  [[nodiscard]] T* add(std::uint64_t number) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[place_of(number / page_size)];
    if (slot.members == 0) {
      slot = {number / page_size, pages_.take(), 0};
      ++used_;
    }
    if ((slot.members & bit(number)) != 0) return nullptr;
    slot.members |= bit(number);
    return &pages_[slot.page][number % page_size];
  }
  void remove(std::uint64_t number) {
    if (slots_.empty()) return;
    const std::size_t place = place_of(number / page_size);
    Slot& slot = slots_[place];
    if (slot.members == 0) return;
    slot.members &= ~bit(number);
    if (slot.members != 0) return;
    pages_.give_back(slot.page);
    --used_;
    close(place);
  }

 private:
  static constexpr std::uint64_t page_size = 16;
  using Page = std::array<T, page_size>;
  struct Slot {
    std::uint64_t number = 0;  // of the page
    std::uint32_t page = 0;
    std::uint32_t members = 0;  // a bit each; nobody uses a slot without any
  };

  static std::uint32_t bit(std::uint64_t number) {
    return std::uint32_t{1} << static_cast<unsigned>(number % page_size);
  }
  [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }
  /// Scattered, or pages that follow each other would stand in long rows.
  [[nodiscard]] std::size_t home_of(std::uint64_t number) const {
    return static_cast<std::size_t>(number * 0x9e3779b97f4a7c15U >> 32) & mask();
  }
  [[nodiscard]] std::size_t next(std::size_t k) const { return (k + 1) & mask(); }
  [[nodiscard]] std::size_t distance(std::size_t from, std::size_t to) const {
    return (to - from) & mask();
  }
  /// Where the page is, or belongs.
  [[nodiscard]] std::size_t place_of(std::uint64_t number) const {
    // Packets of a page come one after the other, and so do the stages of one packet.
    if (slots_[latest_].number == number && slots_[latest_].members != 0) return latest_;
    std::size_t k = home_of(number);
    while (slots_[k].members != 0 && slots_[k].number != number) k = next(k);
    latest_ = k;
    return k;
  }
  /// The slot is free from now on; those behind it that belong before them move up.
  void close(std::size_t hole) {
    for (std::size_t k = next(hole); slots_[k].members != 0; k = next(k)) {
      if (distance(home_of(slots_[k].number), k) < distance(hole, k)) continue;
      slots_[hole] = slots_[k];
      hole = k;
    }
    slots_[hole].members = 0;
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 64 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.members != 0) slots_[place_of(slot.number)] = slot;
    }
  }

  std::vector<Slot> slots_;  // a power of two of them
  std::size_t used_ = 0;
  mutable std::size_t latest_ = 0;  // where a page was found last
  model::SlotPool<Page> pages_;
};

}  // namespace stormproof::props
