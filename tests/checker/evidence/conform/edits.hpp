// Changes to a captured conversation in memory: what a mistaken participant would have sent.
#pragma once

#include <cstdint>
#include <functional>

#include "checker/evidence/capture/events.hpp"

namespace stormproof::conform::testing {

using capture::Conversation;
using capture::Event;
using Matches = std::function<bool(const Event&)>;

/// Index of the participant, or SIZE_MAX if there is none.
[[nodiscard]] std::size_t source_of(const Conversation& conversation, const Event& event);
[[nodiscard]] std::size_t destination_of(const Conversation& conversation, const Event& event);

/// Index of the `nth` event (from 0 on) that matches; throws if there is none.
[[nodiscard]] std::size_t find(const Conversation& conversation, const Matches& matches,
                               std::size_t nth = 0);
/// The last one.
[[nodiscard]] std::size_t find_last(const Conversation& conversation, const Matches& matches);

/// Takes all events out that match.
void drop(Conversation& conversation, const Matches& matches);
void drop(Conversation& conversation, std::size_t event);
/// Lets a datagram of its own carry the event, at `time_ns`; returns its new index.
std::size_t move(Conversation& conversation, std::size_t event, std::int64_t time_ns);
/// Adds a copy of the event, changed; returns its index.
std::size_t add(Conversation& conversation, Event event, std::int64_t time_ns);

}  // namespace stormproof::conform::testing
