// The HEARTBEATs of one writer: a HEARTBEAT to several readers is captured as several datagrams,
// which share its count.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "checker/evidence/conform/dialogue.hpp"

namespace stormproof::conform {

/// The relations of one writer.
struct WriterRelations {
  std::vector<const Relation*> relations{};

  [[nodiscard]] const Place& place() const { return relations.front()->place; }
};

/// One HEARTBEAT of a writer, with all of its copies.
struct SentHeartbeat {
  std::int64_t time_ns = 0;  ///< of the first copy
  std::size_t event = 0;     ///< of the first copy
  Heartbeat heartbeat{};     ///< of the first copy
  std::size_t relation = 0;  ///< of the first copy, index in WriterRelations
  std::size_t copies = 0;
  bool is_behind_data = false;  ///< shares its datagram with DATA
  bool is_directed = false;     ///< names its reader, and shares its datagram with nothing
  bool is_multicast = false;
  bool says_one_thing = true;         ///< all copies announce the same
  std::set<std::size_t> events{};     ///< one of a group is one, whoever is in it
  std::set<std::size_t> receivers{};  ///< of copies by unicast, index in WriterRelations

  [[nodiscard]] bool is_named() const {
    return heartbeat.is_directed && !is_multicast && receivers.size() == 1;
  }
};

struct SentHeartbeats {
  std::vector<SentHeartbeat> all{};         ///< in order of time
  std::optional<SentHeartbeat> repeated{};  ///< the first copy that went to a reader a second time
};

[[nodiscard]] SentHeartbeats sent_heartbeats(const WriterRelations& writer);

}  // namespace stormproof::conform
