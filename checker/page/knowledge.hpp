// Who knows how much of whom, as an observer of a run sees it: of each ordered pair the descriptors
// of its source that have reached its destination. With a Discovery Server the server passes them
// on, and nothing is known of pairs.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "model/engine/submessage.hpp"
#include "model/implementations.hpp"
#include "props/monitors/received_descriptors.hpp"
#include "props/monitors/received_submessages.hpp"

namespace stormproof::page {

class Knowledge {
 public:
  explicit Knowledge(const model::DdsProfile& dds)
      : of_cyclone_{model::traits_of(dds).has_event_thread} {}

  void run_started(const model::Topology& topology) {
    topology_ = &topology;
    known_.assign(topology.pair_count(), 0);
    of_packets_.reset(topology);
    if (of_cyclone_) {
      of_submessages_.reset(topology);
      samples_.reset(topology);
    }
  }
  void received(const model::Packet& packet) {
    of_packets_.arriving(packet);
    if (of_cyclone_) of_submessages_.arriving(packet);
  }
  void transition(const model::Transition& fired) {
    if (of_cyclone_) return hear(fired);
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

  void recount(std::uint32_t pair) {
    const props::RelationWords& words = of_cyclone_ ? samples_ : of_packets_.words();
    std::uint32_t sum = 0;
    for (const std::uint32_t relation : {2 * pair, 2 * pair + 1}) {
      for (std::uint32_t k = 0; k < words.word_count(relation); ++k) {
        sum += static_cast<std::uint32_t>(std::popcount(words.word(relation, k)));
      }
    }
    known_[pair] = sum;
  }

  const bool of_cyclone_;
  const model::Topology* topology_ = nullptr;
  props::ReceivedDescriptors of_packets_;
  props::ReceivedSubmessages of_submessages_;
  props::RelationWords samples_;
  std::vector<std::uint32_t> known_;
};

}  // namespace stormproof::page
