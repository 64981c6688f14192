// Which endpoints have the same type (specs/guide/fastdds.md, "Lookups of types"). Types are common
// to all participants as far as all have their endpoints from the same packages: those of the
// node's own topics and services, and the one of user topics. But the first endpoints of a list of
// services and user topics have, in each participant, a type of their own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/deployment.hpp"
#include "model/engine/node_endpoints.hpp"
#include "model/units.hpp"

namespace stormproof::model::fastdds {

/// Endpoints of services that every node has: requests and replies.
inline constexpr std::uint32_t service_endpoints = 12;

/// How many endpoints of the participant can have a type of their own: those of services that every
/// node has, and user endpoints.
[[nodiscard]] constexpr std::uint64_t endpoints_with_own_types(const Participant& participant) {
  return std::uint64_t{service_endpoints} + participant.publications + participant.subscriptions;
}

/// Different types of one participant, at most.
[[nodiscard]] constexpr std::size_t most_types(const EndpointTypes& types) {
  constexpr std::size_t others = 4;  // of the node's own topics, and of user topics
  return others + std::max(service_endpoints, types.unknown_per_participant);
}

class Types {
 public:
  /// If the deployment does not say that endpoints have types, all are known.
  explicit Types(const Deployment& deployment);

  [[nodiscard]] std::uint32_t of(std::uint32_t participant, Stream s, std::uint32_t d) const;

 private:
  std::vector<std::uint32_t> user_publications_;  // by participant
  std::uint32_t unknown_;                         // of each
};

}  // namespace stormproof::model::fastdds
