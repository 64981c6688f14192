// The events of a run in words: what one party does or sees in an event, and only what changes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/presentation/text/time_text.hpp"
#include "checker/verification/counterexample/history.hpp"
#include "checker/verification/counterexample/relevance.hpp"

namespace stormproof::counterexample {

struct Act {
  enum class Kind : std::uint8_t {
    timer,     ///< something is due
    sent,      ///< a packet joins the backlog of its source
    received,  ///< a packet is processed
    lost,      ///< a packet would have been received
    change,    ///< a machine changes its state, or a timer is started
    channel    ///< service on a channel
  };
  Kind kind{};
  std::uint32_t who = 0;               ///< participant; for `lost` and `channel`: the channel
  std::vector<std::uint64_t> packets;  ///< usually one; several that differ in their number only
  std::string text;
  std::string effect{};  ///< of the composition, that does it; empty: not known
  bool aside = false;    ///< only counts packets that do not matter
};

/// What of the event matters, party by party. At least one act.
[[nodiscard]] std::vector<Act> acts_of(const History& history, std::size_t step,
                                       const Relevance& relevance);

/// "pub", "sub": the stream of a relation or writer with this number.
[[nodiscard]] const char* stream_name(std::uint32_t number);

/// "p14 ACKNACK 1→0 pub, lacks 0–9".
[[nodiscard]] std::string packet_text(const History& history, std::uint64_t packet);

}  // namespace stormproof::counterexample
