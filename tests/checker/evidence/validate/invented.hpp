// A conversation put together event by event, for tests: who says what to whom at which
// millisecond. Every event is a datagram of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/capture/events.hpp"

namespace stormproof::validate::testing {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr capture::EntityId pubs = capture::entity::publications_writer;
inline constexpr capture::EntityId subs = capture::entity::subscriptions_writer;

class Invented {
 public:
  /// A participant on `host`; the first one has number 0.
  Invented& participant(std::size_t host);
  /// SPDP by multicast.
  Invented& announces(std::size_t who, std::int64_t time_ns);
  /// SEDP DATA that describes endpoint `number` of the stream; without `to`, by multicast.
  Invented& describes(std::size_t who, capture::EntityId writer, std::int64_t number,
                      std::optional<std::size_t> to, std::int64_t time_ns);
  /// Every one of 1 … count, to `to`, at once.
  Invented& describes_all(std::size_t who, capture::EntityId writer, std::int64_t count,
                          std::size_t to, std::int64_t time_ns);
  Invented& heartbeat(std::size_t who, capture::EntityId writer, std::int64_t last, std::size_t to,
                      std::int64_t time_ns);
  /// `who` asks `to` for one number.
  Invented& asks(std::size_t who, capture::EntityId writer, std::int64_t number, std::size_t to,
                 std::int64_t time_ns);
  /// Any event; source, destination and traffic are the caller's.
  Invented& adds(capture::Event event, std::uint32_t payload_bytes = 100);

  [[nodiscard]] capture::Event event(std::size_t who, std::optional<std::size_t> to,
                                     capture::EntityId writer, std::int64_t time_ns) const;
  [[nodiscard]] static capture::GuidPrefix prefix(std::size_t who);
  [[nodiscard]] capture::Conversation& conversation() { return conversation_; }

 private:
  capture::Conversation conversation_;
};

/// Two hosts with one participant each; both announce themselves, 0 at 1 ms and 1 at 3 ms.
[[nodiscard]] Invented two_hosts();

}  // namespace stormproof::validate::testing
