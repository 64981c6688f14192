// The HEARTBEATs that a writer of Cyclone DDS sent, each with its copies, and what follows from
// them alone: what they announce, to whom they go, and that they go on while a reader waits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/conform/cyclone.hpp"

namespace stormproof::conform::cyclone {

/// What is wrong with a HEARTBEAT.
[[nodiscard]] Unexplained unexplained_in(const WriterRelations& writer, const SentHeartbeat& one,
                                         Fault kind, std::string what, std::string nearest,
                                         std::vector<Need> needs);

/// All of them in order of time; a fault if they contradict each other.
[[nodiscard]] std::optional<Unexplained> gather(const Context& context,
                                                const WriterRelations& writer,
                                                std::vector<SentHeartbeat>& sent);
/// One that is missing: as long as a reader on another host surely waits, the timer sends to it.
[[nodiscard]] std::optional<Unexplained> overdue(const Context& context,
                                                 const WriterRelations& writer,
                                                 const std::vector<SentHeartbeat>& sent);

}  // namespace stormproof::conform::cyclone
