// What one of the server's relays sent, datagram by datagram, and the parts of its explanation.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/conform/server.hpp"

namespace stormproof::conform::server {

/// A DATA or a GAP with the HEARTBEAT behind it, or a HEARTBEAT alone. Changes are numbered from 0.
struct Passed {
  std::size_t relation = 0;  ///< index in WriterRelations
  std::int64_t time_ns = 0;
  std::size_t event = 0;                  ///< the first
  std::optional<std::uint32_t> change{};  ///< DATA
  bool is_first = false;                  ///< DATA, for the first time to this reader
  bool is_gap = false;
  std::vector<std::uint32_t> gap{};  ///< ascending
  std::optional<Heartbeat> heartbeat{};
  std::size_t heartbeat_event = 0;

  [[nodiscard]] bool is_alone() const { return heartbeat && !change && !is_gap; }
};

/// In order of time.
[[nodiscard]] std::vector<Passed> passed_by(const WriterRelations& relay);

[[nodiscard]] std::optional<Unexplained> explain_heartbeats(const Context& context,
                                                            const WriterRelations& relay,
                                                            const std::vector<Passed>& passed,
                                                            Ledger& ledger);
[[nodiscard]] std::optional<Unexplained> explain_gaps(const Context& context,
                                                      const WriterRelations& relay,
                                                      const std::vector<Passed>& passed,
                                                      Ledger& ledger);
/// What DATA say: which change has which number, and that the server can know it and has to pass
/// it on to this client. That they are sent, and when again, explain_data explains; but not that
/// the server answers a client with its own announcement.
[[nodiscard]] std::optional<Unexplained> check_changes(const Context& context,
                                                       const WriterRelations& relay,
                                                       const std::vector<Passed>& passed,
                                                       Ledger& ledger);

/// What is wrong with one of them.
[[nodiscard]] Unexplained unexplained_in(const WriterRelations& relay, const Passed& one,
                                         std::size_t event, Fault kind, std::string what,
                                         std::string nearest, std::vector<Need> needs = {});

}  // namespace stormproof::conform::server
