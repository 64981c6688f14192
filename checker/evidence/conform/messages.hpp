// The messages of one participant's SEDP writers. A message to several readers is captured as
// several datagrams, one for each; its writer is charged for it once. Copies of a message are made
// at one instant, follow each other closely, say the same, and name no reader (INFO_DST).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/conform/bounds.hpp"
#include "checker/evidence/conform/dialogue.hpp"

namespace stormproof::conform {

/// A DATA or HEARTBEAT in a message.
struct MessagePart {
  std::size_t event = 0;                      ///< of the first copy
  std::optional<std::uint32_t> descriptor{};  ///< DATA
  std::uint32_t count = 0;                    ///< HEARTBEAT
  std::int64_t bytes = 0;                     ///< of the submessage, with its header
};

struct Message {
  capture::EntityId writer = 0;
  std::int64_t time_ns = 0;                ///< of the first copy
  std::int64_t payload_bytes = 0;          ///< of UDP
  bool is_named = false;                   ///< it names its reader
  bool is_pushed = false;                  ///< it carries a descriptor that has just been created
  bool may_be_copy = false;                ///< of the one before it, captured late
  std::int64_t most = 1;                   ///< so many messages its copies may be
  std::vector<MessagePart> parts{};        ///< in order
  std::vector<std::size_t> relations{};    ///< where its copies went, index in Dialogue::relations
  std::vector<std::size_t> first_event{};  ///< of each copy

  [[nodiscard]] bool has_data() const;
};

/// Copies of a message are captured at most this much apart, and no more than the send lag.
inline constexpr std::int64_t copies_within_ns = 1'000'000;

/// What the writers of `participant` sent to other hosts, in order.
[[nodiscard]] std::vector<Message> messages_of(const Dialogue& dialogue, std::size_t participant,
                                               const Bounds& bounds);

}  // namespace stormproof::conform
