// How the event thread of a Cyclone DDS participant fills packets: which messages fit together, and
// which copies a packet is sent as. It is what fsm/composition/cyclone_parts.hpp leaves to the host
// (`Work`); specs/guide/cyclone.md, "The event thread", has the rules.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "model/dds_profile.hpp"
#include "model/engine/submessage.hpp"

namespace stormproof::model::cyclone {

/// The multicast group, as an address.
inline constexpr std::uint32_t group = UINT32_MAX;

/// Where a message goes, fixed when it is made: to one participant by name, or to a set.
struct Destination {
  bool is_set = false;
  std::vector<std::uint32_t> addresses;  ///< participants, ascending; the group comes first
  std::uint32_t writer = UINT32_MAX;     ///< of a set of readers: whose (its number)
  std::uint64_t version = 0;             ///< of a set of readers: how many matches it has seen

  /// By name.
  [[nodiscard]] static Destination only(std::uint32_t participant) {
    return {.is_set = false, .addresses = {participant}};
  }
  [[nodiscard]] bool is_only(std::uint32_t participant) const {
    return !is_set && addresses.front() == participant;
  }
};

struct Message {
  Submessage content;
  Destination to;
  std::int64_t bytes = 0;
  bool retransmission = false;
  bool of_user = false;    ///< of a user topic, which has ports of its own
  bool completes = false;  ///< the packet that it joins is sent at once
};

/// Messages that travel together.
struct Bundle {
  std::vector<Submessage> contents;
  Destination to;
  std::int64_t bytes = 0;  ///< UDP payload
  bool has_retransmission = false;
  bool of_user = false;
  bool is_complete = false;
};

class Packer {
 public:
  explicit Packer(const SedpProfile& sedp) : sedp_{sedp} {}

  /// Adds the message to the open packet, or keeps it for the next one; then the open packet is
  /// complete. Nothing may be held.
  void add(Message&& message);
  /// What is held opens a packet.
  void open_held();
  /// The open packet, complete or because there is nothing more to add, is to be sent now.
  [[nodiscard]] bool is_complete() const {
    return held_.has_value() || (open_ && open_->is_complete);
  }
  [[nodiscard]] bool has_open() const { return open_.has_value(); }
  [[nodiscard]] Bundle take_open();

 private:
  [[nodiscard]] bool fits(const Message& message) const;
  void put(Message&& message);

  const SedpProfile& sedp_;
  std::optional<Bundle> open_;
  std::optional<Message> held_;
};

}  // namespace stormproof::model::cyclone
