// What a Discovery Server and its clients send each other beside SEDP of clients, as RTPS messages:
// reliable announcements, and what the server relays, each change with the number that it has in
// the history of the server's writer. Sizes are those of specs/guide/discovery-server.md.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "checker/evidence/capture/write/identities.hpp"
#include "checker/evidence/capture/write/message_writer.hpp"
#include "model/engine/packet.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/scenario.hpp"

namespace stormproof::capture::write {

class ServerMessages {
 public:
  /// All of it must outlive the object.
  ServerMessages(const model::Scenario& scenario, VendorId vendor,
                 const std::vector<Identity>& identities)
      : scenario_{scenario}, vendor_{vendor}, identities_{identities} {}

  /// Of a registration, or of what is relayed, and their HEARTBEATs and ACKNACKs.
  [[nodiscard]] Buffer message(const model::Packet& packet, std::uint32_t source,
                               std::uint32_t destination, std::int64_t time_ns);
  /// The participant is a new process.
  void start_anew(std::uint32_t participant) {
    registered_.erase(participant);
    std::erase_if(counts_, [&](const auto& count) { return count.first.first == participant; });
  }

 private:
  void register_with(MessageWriter& out, const model::Packet& packet, std::uint32_t source,
                     std::int64_t time_ns);
  void relay(MessageWriter& out, const model::Packet& packet, std::uint32_t source,
             std::int64_t time_ns);
  void add_data(MessageWriter& out, const model::Relayed& relayed, EntityId reader, EntityId writer,
                std::size_t end);
  void acknowledge(MessageWriter& out, const model::Packet& packet, std::uint32_t source);
  [[nodiscard]] std::uint32_t next_count(std::uint32_t source, EntityId entity) {
    return ++counts_[{source, entity}];
  }

  const model::Scenario& scenario_;
  const VendorId vendor_;
  const std::vector<Identity>& identities_;
  std::set<std::uint32_t> registered_;  ///< clients that have sent their DATA(p)
  std::map<std::pair<std::uint32_t, EntityId>, std::uint32_t> counts_;  ///< the last one sent
};

}  // namespace stormproof::capture::write
