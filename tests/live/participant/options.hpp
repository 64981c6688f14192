// What one participant of the live bed is told: its place, what it creates, what it has to
// discover, and where it reports. Written by tests/live/run, so every option but the send buffer is
// required.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stormproof::live {

/// How participants find each other.
enum class Discovery { simple, server, super_client, static_peers };

struct Options {
  std::uint32_t host = 0;                   ///< from 0
  std::uint32_t hosts = 2;                  ///< N_H
  std::uint32_t index = 0;                  ///< on its host, from 0
  std::uint32_t participants_per_host = 0;  ///< N_P, at least 1
  std::uint32_t user_endpoints = 0;         ///< N_E, each participant creates as many
  std::string address{};                    ///< IPv4, the only interface that it uses
  std::vector<std::string> addresses{};     ///< IPv4 of all hosts, with static peers
  std::uint32_t send_buffer = 0;            ///< bytes of the socket send buffer; 0: the system's
  bool simultaneous = false;        ///< create all endpoints first, then enable the participant
  std::int64_t create_over_ns = 0;  ///< spread the creation of endpoints over this time, ns
  Discovery discovery = Discovery::simple;
  bool serves = false;       ///< it is the Discovery Server, at its `address`, without endpoints
  std::string server{};      ///< IPv4 of the Discovery Server
  bool multicast = false;    ///< Cyclone DDS: AllowMulticast true, otherwise spdp
  std::string start_file{};  ///< appears with the start instant in it, in ns since 1970
  std::string report{};      ///< REPORT.ready when it waits for the start, REPORT when complete

  /// User publications; of an odd number of endpoints one more than subscriptions.
  [[nodiscard]] std::uint32_t user_publications() const { return (user_endpoints + 1) / 2; }
  [[nodiscard]] std::uint32_t user_subscriptions() const { return user_endpoints / 2; }
};

/// Throws std::invalid_argument that names the option and what was expected.
[[nodiscard]] Options parse_options(int argc, const char* const* argv);

}  // namespace stormproof::live
