// The HEARTBEATs that a writer of Cyclone DDS sent, each with its copies, and what follows from
// them alone: what they announce, to whom they go, and that they go on while a reader waits.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "checker/evidence/conform/cyclone.hpp"

namespace stormproof::conform::cyclone {

/// The copies of one HEARTBEAT.
struct Sent {
  std::int64_t time_ns = 0;      ///< of the first copy
  std::set<std::size_t> events;  ///< of all copies
  Heartbeat heartbeat{};
  std::set<std::size_t> receivers;  ///< of unicast copies, index in WriterRelations
  bool is_multicast = false;
  bool is_with_data = false;  ///< a datagram of it has DATA of the writer

  [[nodiscard]] std::size_t event() const { return *events.begin(); }
  [[nodiscard]] bool is_named() const {
    return heartbeat.is_directed && !is_multicast && receivers.size() == 1;
  }
};

/// What is wrong with a HEARTBEAT.
[[nodiscard]] Unexplained unexplained_in(const WriterRelations& writer, const Sent& one, Fault kind,
                                         std::string what, std::string nearest,
                                         std::vector<Need> needs);

/// All of them in order of time; a fault if they contradict each other.
[[nodiscard]] std::optional<Unexplained> gather(const Context& context,
                                                const WriterRelations& writer,
                                                std::vector<Sent>& sent);
/// One that is missing: as long as a reader on another host surely waits, the timer sends to it.
[[nodiscard]] std::optional<Unexplained> overdue(const Context& context,
                                                 const WriterRelations& writer,
                                                 const std::vector<Sent>& sent);

}  // namespace stormproof::conform::cyclone
