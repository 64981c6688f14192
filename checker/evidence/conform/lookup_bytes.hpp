// What a participant's questions and answers about types can have added to its group of messages
// (`piggyback: group`), at most. A sample goes to all readers, as copies of one message; so one
// that the capture does not show went to readers on the own host alone, and nobody knows how much
// that was. Where endpoints announce types that can be looked up, and the capture shows no lookup
// at all, it may have been made without them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "checker/evidence/conform/dialogue.hpp"

namespace stormproof::conform {

class LookupBytes {
 public:
  LookupBytes(const Dialogue& dialogue, std::size_t participant);

  /// Bytes of its messages with such samples before this event; nothing: there is no bound.
  [[nodiscard]] std::optional<std::int64_t> most_before(std::size_t event) const;

 private:
  bool is_known_ = true;
  std::map<std::size_t, std::int64_t> sums_{};  ///< by event: of that message and all before it
};

}  // namespace stormproof::conform
