// The host of the third implementation in the simulator: one packet for all descriptors.
#pragma once

#include <vector>

#include "model/engine/discovery_base.hpp"
#include "model/engine/relation_bits.hpp"
#include "tests/model/push_once/push_once.hpp"

namespace stormproof::model {

namespace rules_of_push_once = fsm::composition::push_once;

class PushOnceHost final
    : public Stored<PushOnceHost, DiscoveryBase,
                    ThingsBeside<rules_of_push_once::PushOnce, DiscoveryBase>> {
  using C = rules_of_push_once::C;
  using Data = rules_of_push_once::Data;
  using Heartbeat = rules_of_push_once::Heartbeat;
  using AckNack = rules_of_push_once::AckNack;
  using WriterOpen = rules_of_push_once::WriterOpen;

 public:
  using Composition = rules_of_push_once::PushOnce;

  using Stored::Stored;

  void start() override {
    for (std::uint32_t i = 0; i < topology().participant_count(); ++i) start_announcing(i);
  }
  void handle(const Event& event) override { run_due(*this, event); }
  void source_completed(const Packet&) override {}
  [[nodiscard]] bool receives_separately() const override { return false; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet&) const override { return {}; }
  void received(const Packet& packet, std::uint32_t) override {
    const std::uint32_t relation = packet.relation();
    if (packet.multicast()) {
      for (std::uint32_t pair = topology().first_pair(packet.pair);
           pair < topology().first_pair(packet.pair + 1); ++pair) {
        run_rule<comp::Received<comp::SpdpMulticast>>(*this, pair);
      }
    } else if (packet.kind == PacketKind::data) {
      run_rule<comp::Received<Data>>(*this, relation, &packet);
    } else if (packet.kind == PacketKind::heartbeat) {
      run_rule<comp::Received<Heartbeat>>(*this, relation, &packet);
    } else if (packet.kind == PacketKind::acknack) {
      run_rule<comp::Received<AckNack>>(*this, relation, &packet);
    } else {
      run_rule<comp::Received<comp::SpdpUnicast>>(*this, packet.pair);
    }
  }
  void renew_bitmap(Packet&) override {}
  [[nodiscard]] std::uint32_t next_recipient(const Packet&, std::uint32_t pair) const override {
    return pair;
  }
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override {
    return planes().list_missing(limit);
  }

  using DiscoveryBase::emit;
  using DiscoveryBase::perform;
  using Stored::word;
  [[nodiscard]] std::uint64_t word(comp::BelowBase, const Packet& packet, std::uint32_t k) const {
    return bits_below(packet.descriptors.lowest(), k);
  }
  [[nodiscard]] std::vector<std::uint32_t> readers(std::uint32_t w) const {
    return open_relations(w);
  }

  template <class World, class Sayings>
  void emit(Heartbeat, World& w, const Sayings&) {
    const std::uint32_t relation = w.template number<comp::owner::relation>();
    network_.emit(ends(relation).source, packet_on(PacketKind::heartbeat, relation, bytes));
  }
  template <class World, class... Sayings>
  void emit(AckNack, World& w, const std::tuple<Sayings...>& sayings) {
    const std::uint32_t relation = w.template number<comp::owner::relation>();
    Packet packet = packet_on(PacketKind::acknack, relation, bytes);
    packet.initial_acknack = sizeof...(Sayings) == 1;
    if constexpr (sizeof...(Sayings) > 1) {
      packet.descriptors = w.set_of(said_of<comp::Listed>(sayings));
    }
    network_.emit(ends(relation).destination, std::move(packet));
  }
  template <class World>
  void perform(rules_of_push_once::Push, World& w) {
    const std::uint32_t relation = w.template number<comp::owner::relation>();
    Packet packet = packet_on(PacketKind::data, relation, bytes);
    packet.descriptors = w.set_of(comp::everyone);
    if (packet.descriptors.empty()) return;  // a packet carries something
    packet.carries_initial = true;
    network_.emit(ends(relation).source, std::move(packet));
  }

 private:
  static constexpr std::int64_t bytes = 500;

  void send_spdp_multicast(std::uint32_t i) override {
    network_.emit(i, packet_of(PacketKind::spdp_multicast, i, bytes));
  }
  void send_spdp_copy(std::uint32_t pair) override {
    network_.emit(topology().pair(pair).source, packet_of(PacketKind::spdp_unicast, pair, bytes));
  }
  void send_spdp_to_known(std::uint32_t i) override {
    for (std::uint32_t pair = topology().first_pair(i); pair < topology().first_pair(i + 1);
         ++pair) {
      if (at<comp::Recognised>(topology().pair(pair).reverse)) send_spdp_copy(pair);
    }
  }
  void refill(std::uint32_t) override {}  // nothing is charged
  [[nodiscard]] std::vector<std::uint32_t> open_relations(std::uint32_t w) const override {
    std::vector<std::uint32_t> relations;
    for (std::uint32_t relation = 0; relation < topology().relation_count(); ++relation) {
      if (at<WriterOpen>(relation) && writer_of(relation) == w) relations.push_back(relation);
    }
    return relations;
  }
};

}  // namespace stormproof::model
