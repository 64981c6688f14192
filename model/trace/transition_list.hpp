// The transitions of one event. Descriptor machines report theirs per 64 descriptors and per class
// of input; here they become one entry per relation and move, with all its descriptors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/probe.hpp"

namespace stormproof::model::trace {

class TransitionList {
 public:
  struct Entry {
    MachineRef machine;
    std::string_view event;
    std::string_view before;
    std::string_view after;
    std::vector<std::uint64_t> words;  ///< the descriptors that moved; empty for other machines
  };

  void add(const Transition& fired);
  void clear() { used_ = 0; }

  [[nodiscard]] std::span<const Entry> entries() const { return {entries_.data(), used_}; }

 private:
  /// The entry of this move among those of the machine that moved last, or null.
  Entry* find(const Transition& fired);
  Entry& append();

  std::vector<Entry> entries_;  // those from `used_` on keep their memory for the next event
  std::size_t used_ = 0;
};

}  // namespace stormproof::model::trace
