// Which repairs of a captured discovery were needless: what the capture shows before each of them.
// Nothing here needs a model; the rules are those of the protocol (RTPS 2.5, section 8.4).
//
// * A repair of DATA that the reader had acknowledged is needless, unless the reader has forgotten
//   it since: it asks again for what it had acknowledged.
// * A repair answers a loss if the reader asked for it although it had what was sent later: packets
//   of one sender arrive in order unless one is lost.
// * Any other repair was asked for while its DATA was under way, or waited in the sender's queue.
#pragma once

#include <cstdint>
#include <map>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::doctor {

enum class RepairKind : std::uint8_t { acknowledged, lost, forgotten, under_way };

struct Repairs {
  std::uint64_t acknowledged = 0;  ///< of what the reader had acknowledged
  std::uint64_t lost = 0;
  std::uint64_t forgotten = 0;  ///< for a reader that begins anew
  std::uint64_t under_way = 0;
  std::map<std::size_t, RepairKind> kinds{};  ///< by the event's position in the conversation

  [[nodiscard]] std::uint64_t needless() const { return acknowledged + under_way; }
  [[nodiscard]] std::uint64_t needed() const { return lost + forgotten; }
};

/// Of the events that `counting` has classes for, until `end_ns` (inclusive).
[[nodiscard]] Repairs find_repairs(const capture::Conversation& conversation,
                                   const capture::Counting& counting, std::int64_t end_ns);

}  // namespace stormproof::doctor
