// What the event thread of a Cyclone DDS participant has to do, as composition.followed has it:
// timers that are due, messages that wait, the packet that is being filled, and the one that is
// being sent. Which messages share a packet is said in specs/guide/cyclone.md, "Timers and the
// event thread"; nothing here is the simulator's but the sizes of messages.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "model/cyclone/endpoints.hpp"
#include "model/dds_profile.hpp"
#include "props/monitors/deeds.hpp"

namespace stormproof::props {

/// Where a message goes: to one participant by name, or to a set.
struct CycloneDestination {
  static constexpr std::uint32_t group = UINT32_MAX;

  bool is_set = false;
  std::vector<std::uint32_t> addresses;  ///< participants, ascending; or the group first
  std::uint32_t writer = UINT32_MAX;     ///< of a set of readers: whose
  std::uint64_t version = 0;             ///< of a set of readers: how many have been matched

  [[nodiscard]] static CycloneDestination only(std::uint32_t participant) {
    return {.is_set = false, .addresses = {participant}};
  }
  [[nodiscard]] bool is_only(std::uint32_t participant) const {
    return !is_set && addresses.front() == participant;
  }
};

struct CycloneMessage {
  Message content;
  CycloneDestination to;
  std::int64_t bytes = 0;
  bool is_repair = false;  ///< a retransmission

  /// Topics have ports of their own.
  [[nodiscard]] bool is_of_topic() const {
    return content.writer >= model::cyclone::writer::first_topic;
  }
};

/// Of a message with this content; `known` is how many samples of the stream its reader knows to
/// exist, up to which the bitmap of an ACKNACK goes.
[[nodiscard]] std::int64_t bytes_of(const Message& content, std::int64_t known, bool multicast);
/// Of a packet with these messages.
[[nodiscard]] std::int64_t bytes_of(const std::vector<CycloneMessage>& packet);

class CycloneThread {
 public:
  /// A HEARTBEAT that waits for the end of the received packet, and the relation that it answers.
  struct Answer {
    std::uint32_t relation = 0;
    CycloneMessage message;
  };
  std::optional<Answer> answer;
  std::deque<CycloneMessage> queue;
  std::deque<std::function<void()>> list;  ///< the timers that are due, as what firing them does

  /// What the timer that fires gives.
  void give(CycloneMessage&& message) { given_ = std::move(message); }
  /// Goes on until a packet is full or nothing is left. What it carries then; empty if there is
  /// nothing to send.
  [[nodiscard]] std::vector<CycloneMessage> fill(const model::SedpProfile& sedp);

  Message sent;                    ///< the packet that is being sent
  std::deque<std::uint32_t> left;  ///< and where to

 private:
  bool take_next(const model::SedpProfile& sedp);

  std::optional<CycloneMessage> given_;
  std::vector<CycloneMessage> open_;  ///< a packet that is being filled
  std::optional<CycloneMessage> held_;
};

}  // namespace stormproof::props
