// Between which entities the packets of control-only relations go: the model numbers these
// relations densely, pair by pair (model/fastdds/control.cpp); a capture has entity ids.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "checker/evidence/capture/write/identities.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::capture::write {

class ControlTopics {
 public:
  struct Ends {
    EntityId writer = 0;
    EntityId reader = 0;
    bool is_builtin = false;  ///< otherwise user endpoints, with ports of their own
  };

  /// Each cross-host pair has liveliness, the two topics of every node, and the user topics that
  /// its source publishes and its destination subscribes to; with a server only liveliness. What
  /// looks up types comes last, of every pair: questions, then answers.
  ControlTopics(const model::Topology& topology, const model::Scenario& scenario) {
    std::uint32_t relations = 0;
    for (std::uint32_t number = 0; number < topology.pair_count(); ++number) {
      first_relation_.push_back(relations);
      const model::Pair& pair = topology.pair(number);
      const bool ask = model::fastdds::looks_up_types(dds_of(scenario, pair.source)) &&
                       model::fastdds::looks_up_types(dds_of(scenario, pair.destination));
      lookups_.push_back(ask ? 2 : 0);
      relations += lookups_.back();
      if (!pair.cross_host) continue;
      const std::uint32_t publications = topology.descriptor_count(pair.source, model::Stream::pub);
      const std::uint32_t subscriptions =
          topology.descriptor_count(pair.destination, model::Stream::sub);
      if (publications == 0 || subscriptions == 0) {  // one of them is a Discovery Server
        ++relations;
        continue;
      }
      relations += model::fastdds::topic::first_user +
                   std::min(publications - model::fastdds::default_publications,
                            subscriptions - model::fastdds::default_subscriptions);
    }
    first_relation_.push_back(relations);
  }

  [[nodiscard]] Ends ends(const model::Packet& packet) const {
    const std::uint32_t after = first_relation_[packet.pair + 1] - packet.detail;
    if (after <= lookups_[packet.pair]) {
      return after == 2 ? Ends{0x000300c3, 0x000300c4, true} : Ends{0x000301c3, 0x000301c4, true};
    }
    const std::uint32_t topic = packet.detail - first_relation_[packet.pair];
    if (topic == model::fastdds::topic::liveliness) {
      return {capture::entity::liveliness_writer, entity::liveliness_reader, true};
    }
    const auto endpoint = [topic](model::Stream stream) {
      return endpoint_entity(stream, model::fastdds::descriptor_on(topic, stream));
    };
    return {endpoint(model::Stream::pub), endpoint(model::Stream::sub), false};
  }

 private:
  std::vector<std::uint32_t> lookups_;         ///< by pair
  std::vector<std::uint32_t> first_relation_;  ///< by pair
};

}  // namespace stormproof::capture::write
