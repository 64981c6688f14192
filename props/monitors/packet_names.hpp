// Names for packets by which the same one is found in another run, where it has another number:
// sender, receiver, kind, stream, and the how manieth of those it is.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "model/engine/packet.hpp"

namespace stormproof::props {

class PacketNames {
 public:
  /// Receiver of a packet to the group.
  static constexpr std::uint32_t everybody = UINT32_MAX;
  /// Sender, receiver, kind, stream, whether it is an initial ACKNACK.
  using Family = std::tuple<std::uint32_t, std::uint32_t, model::PacketKind, model::Stream, bool>;
  using Name = std::pair<Family, std::uint64_t>;

  /// `originals[i]` is the number that participant i has in names.
  explicit PacketNames(std::vector<std::uint32_t> originals) : originals_{std::move(originals)} {}

  /// Of the copies of a packet that is emitted, in the order of their numbers; to be called once
  /// for each packet, in the order of emission.
  [[nodiscard]] std::vector<Name> of(const model::Packet& packet, std::uint32_t source,
                                     std::span<const std::uint32_t> destinations) {
    std::vector<Name> names;
    for (std::uint32_t copy = 0; copy < packet.copies; ++copy) {
      const bool has_one = !packet.multicast() && copy < destinations.size();
      const std::uint32_t to = has_one ? originals_[destinations[copy]] : everybody;
      const Family family{originals_[source], to, packet.kind, packet.stream,
                          packet.initial_acknack};
      names.emplace_back(family, counts_[family]++);
    }
    return names;
  }

 private:
  std::vector<std::uint32_t> originals_;
  std::map<Family, std::uint64_t> counts_;
};

}  // namespace stormproof::props
