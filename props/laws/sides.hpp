// What an outside observer knows of both sides of the relations: who has recognised whom, which
// sides are open, and which HEARTBEATs and ACKNACKs they take. From packets and start times alone.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/implementations.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

class SideWatch : public Observer {
 public:
  SideWatch(std::string_view law, const model::Scenario& scenario)
      : Observer{law}, scenario_{scenario}, rules_{model::rules_of(scenario.dds)} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(own_.emplace(topology));
    reader_open_.assign(topology.relation_count(), false);
    writer_open_ = reader_open_;
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    using enum model::PacketKind;
    if (packet.kind == spdp_multicast && receiver == everybody) {
      for (std::uint32_t pair = topology().first_pair(packet.pair);
           pair < topology().first_pair(packet.pair + 1); ++pair) {
        recognise(pair);
      }
    } else if (packet.kind == spdp_multicast) {
      recognise(topology().pair_between(packet.pair, receiver));
    } else if (packet.kind == spdp_unicast) {
      recognise(packet.pair);
    }
    const bool reminds =
        packet.kind == heartbeat || (packet.kind == data && packet.carries_heartbeat);
    if (reminds && takes_heartbeats(packet.relation())) heartbeat_taken(packet.relation());
    const bool taken = packet.kind == acknack && writer_open_[packet.relation()];
    if (taken && has_started(topology().pair(packet.pair).source)) acknack_taken(packet);
  }

 protected:
  /// The destination of the pair has recognised its source.
  virtual void recognised(std::uint32_t /*pair*/) {}
  virtual void reader_opened(std::uint32_t /*relation*/) {}
  virtual void writer_opened(std::uint32_t /*relation*/) {}
  virtual void heartbeat_taken(std::uint32_t /*relation*/) {}
  virtual void acknack_taken(const model::Packet&) {}

  [[nodiscard]] const model::Scenario& scenario() const { return scenario_; }
  [[nodiscard]] const model::RelationRules& rules() const { return rules_; }
  [[nodiscard]] bool has_recognised(std::uint32_t pair) const { return reader_open_[2 * pair]; }
  [[nodiscard]] bool is_writer_open(std::uint32_t relation) const { return writer_open_[relation]; }

  /// `act` on the relation of each packet that the record stands for.
  template <class Act>
  void for_relations(const model::Packet& packet, std::uint32_t source,
                     std::span<const std::uint32_t> destinations, Act&& act) const {
    if (packet.copies == 1) return act(packet.relation());
    for (const std::uint32_t destination : destinations) {
      act(2 * topology().pair_between(source, destination) + packet.relation() % 2);
    }
  }

 private:
  [[nodiscard]] bool has_started(std::uint32_t participant) const {
    return now() >= topology().start(participant);
  }
  [[nodiscard]] bool takes_heartbeats(std::uint32_t relation) const {
    if (!has_started(topology().pair(relation / 2).destination)) return false;
    return reader_open_[relation] || (rules_.unmatched == model::Unmatched::accept &&
                                      rules_.relation_opening == model::RelationOpening::each_side);
  }
  void recognise(std::uint32_t pair) {
    if (!has_started(topology().pair(pair).destination) || reader_open_[2 * pair]) return;
    const bool both_at_once = rules_.relation_opening == model::RelationOpening::receiver;
    const std::uint32_t writers = both_at_once ? pair : topology().pair(pair).reverse;
    for (std::uint32_t stream = 0; stream < 2; ++stream) {
      reader_open_[2 * pair + stream] = true;
      writer_open_[2 * writers + stream] = true;
    }
    recognised(pair);
    for (std::uint32_t stream = 0; stream < 2; ++stream) {
      reader_opened(2 * pair + stream);
      writer_opened(2 * writers + stream);
    }
  }

  const model::Scenario& scenario_;
  model::RelationRules rules_;
  std::optional<model::Topology> own_;  // names what is missing when the run is over
  std::vector<bool> reader_open_;       // by relation
  std::vector<bool> writer_open_;
};

}  // namespace stormproof::props
