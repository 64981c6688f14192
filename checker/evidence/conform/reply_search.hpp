// Finds, for all replies of a reader, how far it had got with the messages of its writer when it
// generated each. Mostly the least that explains an ACKNACK is right, because what has not arrived
// yet can arrive later or be lost. But a datagram of which a part has arrived cannot be lost any
// more, so choices are taken back when a later reply cannot be explained.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "checker/evidence/conform/arrivals.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

/// How submessages explain one ACKNACK: those before `end` have arrived or are lost.
struct Choice {
  std::size_t end = 0;
  Arrivals arrivals{};
  /// The reception that schedules the ACKNACK; nothing: a HEARTBEAT that arrived while the reply
  /// before it was being generated. Its timer had fired already, so it was armed again.
  std::optional<std::int64_t> heartbeat_ns{};
};

/// What is wrong with the HEARTBEAT that an ACKNACK would answer.
struct Misplaced {
  std::size_t heartbeat = 0;  ///< index in Relation::sent
  std::int64_t early_ns = 0;  ///< the ACKNACK comes that much too early after it, or
  std::int64_t late_ns = 0;   ///< that much too late
};

struct ReplySearch {
  enum class Kind : std::uint8_t { explained, not_explained, given_up };
  Kind kind = Kind::explained;
  std::vector<Choice> choices{};  ///< of all replies; `not_explained`: of those before `failed`
  std::size_t failed = 0;         ///< the first reply that no choice explains
  std::optional<Misplaced> misplaced{};  ///< its content would fit, but the time does not
};

/// `replies` are ACKNACKs of `relation` that are not initial, in order. If nothing may be lost, the
/// first `may_be_dropped` submessages can still be missing: the reader side was not open.
[[nodiscard]] ReplySearch search_replies(const Relation& relation,
                                         std::span<const Answer* const> replies,
                                         const model::SedpProfile& sedp, const Bounds& bounds,
                                         std::size_t may_be_dropped = 0);

/// How many submessages had been sent when something happened at `time_ns` at the reader.
[[nodiscard]] std::size_t sent_until(const Relation& relation, std::int64_t time_ns,
                                     const Bounds& bounds);
/// How many of them are no longer under way when `answer` is generated.
[[nodiscard]] std::size_t expired(const Relation& relation, const Answer& answer,
                                  const Bounds& bounds);

}  // namespace stormproof::conform
