// X as an observer sees it: a descriptor has been received when a packet that carries it reaches
// its reader and a DataReceived row of the DiscoveryReader fires, which is what takes the DATA. A
// reader side that drops the packet fires none.
#pragma once

#include <string_view>

#include "model/engine/packet.hpp"
#include "model/probe.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::props {

class ReceivedDescriptors {
 public:
  /// The event of a machine that is a new one (model/engine/living_host.hpp).
  static constexpr std::string_view renewed = "Renewed";

  void reset(const model::Topology& topology) {
    words_.reset(topology);
    arriving_ = nullptr;
  }

  /// To be called from `received`; the packet must live until the event is over.
  void arriving(const model::Packet& packet) {
    arriving_ = packet.kind == model::PacketKind::data ? &packet : nullptr;
  }
  /// To be called from `transition`: the packet whose DATA the reader takes now, or null. X is
  /// still the old one; `take` makes it the new one.
  [[nodiscard]] const model::Packet* taken(const model::MachineRef& machine,
                                           std::string_view event) const {
    if (arriving_ == nullptr || event != "DataReceived") return nullptr;
    const bool here =
        machine.machine == "DiscoveryReader" && machine.subject == arriving_->relation();
    return here ? arriving_ : nullptr;
  }
  /// To be called from `transition`: whether the reader is a new one that has nothing.
  [[nodiscard]] static bool is_new(const model::MachineRef& machine, std::string_view event) {
    return event == renewed && machine.machine == "DiscoveryReader";
  }
  void lose(std::uint32_t relation) {
    for (std::uint32_t k = 0; k < word_count(relation); ++k) words_.word(relation, k) = 0;
  }
  void take(const model::Packet& packet) { take(packet.relation(), packet.descriptors); }
  void take(std::uint32_t relation, const model::DescriptorSet& set) { words_.add(relation, set); }

  [[nodiscard]] std::uint64_t word(std::uint32_t relation, std::uint32_t k) const {
    return words_.word(relation, k);
  }
  [[nodiscard]] std::uint32_t word_count(std::uint32_t relation) const {
    return words_.word_count(relation);
  }
  [[nodiscard]] const RelationWords& words() const { return words_; }

 private:
  RelationWords words_;
  const model::Packet* arriving_ = nullptr;
};

}  // namespace stormproof::props
