// Which descriptors a participant needs: those on topics of which it has the other side. With a
// Discovery Server discovery is complete when everybody has these
// (specs/guide/discovery-server.md, "Deployment with a server").
#pragma once

#include <cstdint>

#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

/// Whether participant j has the other side of the topic of descriptor d of stream s.
[[nodiscard]] inline bool has_other_side(const Topology& topology, std::uint32_t j, Stream s,
                                         std::uint32_t d) {
  const Stream other = s == Stream::pub ? Stream::sub : Stream::pub;
  const std::uint32_t t = topic_of(s, d);
  return t != topic::none && descriptor_on(t, other) < topology.descriptor_count(j, other);
}

}  // namespace stormproof::model::fastdds
