// `stormproof init`: the first scenario of somebody's own system, with a comment beside every
// number that says what it means and where it comes from. What is drafted is read back before
// anybody sees it, so it is a scenario.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::init {

/// What a user knows of his system.
struct System {
  std::uint32_t hosts = 2;
  std::uint32_t participants = 4;  ///< of each host
  std::uint32_t endpoints = 20;    ///< of each participant, without those that every node has
  std::string ros = "humble";      ///< a distribution of specs/distributions.yaml
  bool knows_ros = false;          ///< `ros` is given, not assumed: it reads the vendor's file
  std::string rmw = "fastrtps";    ///< or "cyclonedds"
  std::string dds{};               ///< a profile or the vendor's file instead of both; may be empty
  std::string discovery{};       ///< of Fast DDS: "server", "super_client", "static"; empty: simple
  std::uint32_t peer_ports = 4;  ///< of each host, with "static"
  std::uint32_t servers = 1;     ///< Discovery Servers that everybody is a client of
  std::string wireless = "wifi-80211n";
  /// Message types of a participant that another one does not have, where participants ask for
  /// types (Fast DDS 3); nothing: `usual_unknown_types`.
  std::optional<std::uint32_t> unknown_types{};
  std::vector<std::string> remarks{};  ///< written at the top, one line each
};

/// So many types that nobody else has would give as many lookups, if each process of Nav2 had them,
/// as those that its processes have (specs/published/nav2-types.yaml): 12.0.
inline constexpr std::uint32_t usual_unknown_types = 12;

/// Whether its participants ask for types that they do not know.
[[nodiscard]] bool looks_up_types(const System& system, const model::config::SpecPath& specs);

/// The scenario as text. Errors: an unknown distribution, RMW or profile; numbers that no scenario
/// takes.
[[nodiscard]] model::config::Result<std::string> draft(const System& system,
                                                       const model::config::SpecPath& specs);

/// The deployment that a capture shows, over `system.wireless`, with `system.dds` or the shipped
/// profile that fits the capture best.
[[nodiscard]] model::config::Result<std::string> draft_of_capture(
    const capture::Conversation& conversation, const System& system);

}  // namespace stormproof::init
