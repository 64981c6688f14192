// Who knows how much of whom, as an observer of a run sees it: of each ordered pair the descriptors
// of its source that have reached its destination. With a Discovery Server, which passes them on,
// those that the destination needs: whose topic it has the opposite side of.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "model/composition_of.hpp"
#include "model/engine/submessage.hpp"
#include "model/fastdds/matching.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"
#include "props/monitors/received_descriptors.hpp"
#include "props/monitors/received_submessages.hpp"

namespace stormproof::page {

class Knowledge {
 public:
  explicit Knowledge(const model::Scenario& scenario)
      : of_cyclone_{model::traits_of(scenario.dds).has_event_thread},
        is_relayed_{model::traits_of(scenario.dds).has_server},
        descriptors_{scenario.dds.descriptors} {}

  /// Whether it can be said: not where a server lives, since what clients forget without being told
  /// is in no packet.
  [[nodiscard]] static bool is_known(const model::Scenario& scenario) {
    return !model::traits_of(scenario.dds).has_server || !model::is_living(scenario);
  }

  void run_started(const model::Topology& topology) {
    topology_ = &topology;
    known_.assign(topology.pair_count(), 0);
    of_packets_.reset(topology);
    if (of_cyclone_) of_submessages_.reset(topology);
    if (of_cyclone_ || is_relayed_) samples_.reset(topology);
  }
  void received(const model::Packet& packet) {
    of_packets_.arriving(packet);
    if (of_cyclone_) of_submessages_.arriving(packet);
    if (is_relayed_ && packet.relayed != nullptr && packet.relayed->has_data) learn(packet);
  }
  void transition(const model::Transition& fired) {
    if (of_cyclone_) return hear(fired);
    if (is_relayed_) return;
    if (props::ReceivedDescriptors::is_new(fired.machine, fired.event)) {
      of_packets_.lose(fired.machine.subject);
      recount(fired.machine.subject / 2);
    } else if (const auto* packet = of_packets_.taken(fired.machine, fired.event)) {
      of_packets_.take(*packet);
      recount(packet->pair);
    }
  }

  /// How many descriptors of the pair's source its destination knows.
  [[nodiscard]] std::uint32_t known(std::uint32_t pair) const { return known_[pair]; }
  /// How many there are.
  [[nodiscard]] std::uint32_t all(std::uint32_t pair) const {
    const model::Pair& ends = topology_->pair(pair);
    if (is_relayed_) {
      return topology_->matching_descriptors(ends.source, ends.destination, descriptors_);
    }
    return topology_->descriptor_count(2 * pair) + topology_->descriptor_count(2 * pair + 1);
  }

 private:
  /// A reader of Cyclone DDS takes each sample once.
  void hear(const model::Transition& fired) {
    const model::Submessage* heard = of_submessages_.heard(fired.machine, fired.event);
    if (heard == nullptr || heard->kind != model::Submessage::Kind::data) return;
    if (!of_submessages_.is_of_stream(fired.machine.subject)) return;
    const std::uint32_t pair = fired.machine.subject / of_submessages_.stride();
    const std::uint32_t relation = 2 * pair + fired.machine.subject % of_submessages_.stride();
    if (heard->sample >= topology_->descriptor_count(relation)) return;
    samples_.word(relation, heard->sample / 64) |= std::uint64_t{1} << heard->sample % 64;
    recount(pair);
  }

  /// What a client is told by the server.
  void learn(const model::Packet& packet) {
    const model::Relayed& relayed = *packet.relayed;
    const std::uint32_t client = topology_->pair(packet.pair).destination;
    if (relayed.is_announcement || relayed.participant == client) return;
    if (!model::fastdds::has_other_side(*topology_, client, relayed.stream, relayed.descriptor)) {
      return;
    }
    const std::uint32_t pair = topology_->pair_between(relayed.participant, client);
    const auto relation = static_cast<std::uint32_t>(2 * pair + model::index_of(relayed.stream));
    samples_.word(relation, relayed.descriptor / 64) |= std::uint64_t{1} << relayed.descriptor % 64;
    recount(pair);
  }

  void recount(std::uint32_t pair) {
    const props::RelationWords& words = of_cyclone_ || is_relayed_ ? samples_ : of_packets_.words();
    std::uint32_t sum = 0;
    for (const std::uint32_t relation : {2 * pair, 2 * pair + 1}) {
      for (std::uint32_t k = 0; k < words.word_count(relation); ++k) {
        sum += static_cast<std::uint32_t>(std::popcount(words.word(relation, k)));
      }
    }
    known_[pair] = sum;
  }

  const bool of_cyclone_;
  const bool is_relayed_;
  const model::DescriptorProfile descriptors_;
  const model::Topology* topology_ = nullptr;
  props::ReceivedDescriptors of_packets_;
  props::ReceivedSubmessages of_submessages_;
  props::RelationWords samples_;
  std::vector<std::uint32_t> known_;
};

}  // namespace stormproof::page
