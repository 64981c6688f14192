// The packets of the explored relations in a run of the simulator, as the slots that they are in a
// path, and the announcements, which open these relations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "checker/engines/explorer/replay.hpp"

namespace stormproof::explorer {

/// Notes those from participant 0 to the readers, and back. Reader r is participant r + 1.
class PacketList final : public model::Probe {
 public:
  /// A packet to or from one reader; in Cyclone DDS a part of one (cyclone_messages.hpp).
  struct Entry {
    std::uint64_t number = 0;
    model::Nanoseconds emitted;
    Slot slot;
    std::uint32_t source = 0;
    std::uint32_t reader = 0;  ///< of an announcement of participant 0: of a copy to one
    bool is_part = false;

    /// Whether it is what was expected. Counts are said in another way, and of packets of other
    /// implementations no more is known than what they carry.
    [[nodiscard]] bool is(const Slot& expected) const;
  };
  std::vector<Entry> of_relations;
  std::vector<Entry> announcements;

  explicit PacketList(const Scope& scope) : scope_{scope} {}

  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;

 private:
  void note_message(const model::Packet& packet, Entry entry);

  const Scope& scope_;
};

}  // namespace stormproof::explorer
