// The deployment: who takes part, on which host, from when on, and with how many user endpoints (the paper's
// structural discovery workload; specs/model.md, section "Deployment"). Pure data; a scenario file or a
// caller fills it in.
#pragma once

#include <cstdint>
#include <vector>

#include "model/units.hpp"

namespace stormproof::model {

/// One DDS participant. The numbers of user endpoints come on top of the profile's default descriptors.
struct Participant {
  HostId host;
  std::uint32_t publications = 0;   ///< user publications, 0 … Deployment::max_endpoints
  std::uint32_t subscriptions = 0;  ///< user subscriptions, 0 … Deployment::max_endpoints
  Nanoseconds start;                ///< ≥ 0; before it the participant ignores all that reaches it
  Nanoseconds endpoints_done;       ///< ≥ start; all endpoints created (`implementation: fastdds` only)

  bool operator==(const Participant&) const = default;
};

struct Deployment {
  /// Largest deployment that is accepted. 4,000 participants on two hosts are 16 million relations.
  static constexpr std::uint32_t max_participants = 4'000;
  static constexpr std::uint32_t max_endpoints = 100'000;

  std::vector<Participant> participants;  ///< numbered in this order
  /// Delay of same-host packets, ≥ 0 (`implementation: fastdds` only).
  Nanoseconds loopback_delay{2'000'000};

  /// The short form: host 0's participants first, each with ceil(E/2) publications and floor(E/2) subscriptions.
  [[nodiscard]] static Deployment homogeneous(std::uint32_t hosts, std::uint32_t participants_per_host,
                                              std::uint32_t endpoints_per_participant);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(participants.size()); }
  /// Number of different hosts that carry at least one participant.
  [[nodiscard]] std::uint32_t host_count() const;
  /// Whether at least one cross-host pair exists; without one there is nothing to discover.
  [[nodiscard]] bool has_cross_host_pair() const { return host_count() > 1; }

  bool operator==(const Deployment&) const = default;
};

}  // namespace stormproof::model
