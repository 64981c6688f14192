// A network with an implementation that only listens, and the loop over its events.
#include "tests/model/packet_feed.hpp"

#include "model/engine/network.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof {

namespace {

class Listener final : public model::Implementation {
 public:
  Listener(const model::RunState& run, std::size_t packets) : arrived(packets, -1), run_{run} {}

  void start() override {}
  void handle(const model::Event&) override {}
  void source_completed(const model::Packet&) override {}
  [[nodiscard]] bool receives_separately() const override { return true; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const model::Packet& packet) const override {
    if (!packet.multicast()) return {run_.topology.pair(packet.pair).destination};
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < run_.topology.participant_count(); ++i) {
      if (i != packet.pair) all.push_back(i);
    }
    return all;
  }
  void received(const model::Packet& packet, std::uint32_t) override {
    arrived[packet.number] = run_.now.count();
  }
  void renew_bitmap(model::Packet&) override {}
  [[nodiscard]] std::uint32_t next_recipient(const model::Packet&,
                                             std::uint32_t pair) const override {
    return pair;
  }
  [[nodiscard]] std::vector<model::MissingDescriptor> missing(std::size_t) override { return {}; }

  std::vector<std::int64_t> arrived;

 private:
  const model::RunState& run_;
};

model::Packet packet_of(const vectors::ChannelPacket& listed, const model::Topology& topology) {
  model::Packet packet;
  packet.kind = listed.destination ? model::PacketKind::data : model::PacketKind::spdp_multicast;
  packet.pair = listed.destination ? topology.pair_between(listed.source, *listed.destination)
                                   : listed.source;
  packet.payload_bytes = listed.payload_bytes;
  packet.port = listed.port;
  return packet;
}

}  // namespace

std::vector<std::int64_t> arrivals(const model::WirelessProfile& wireless, std::uint32_t hosts,
                                   const std::vector<vectors::ChannelPacket>& packets) {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, 1, 0);
  scenario.wireless = wireless;
  model::RunState run{scenario, nullptr};
  model::Network network{run};
  Listener listener{run, packets.size()};
  network.attach(listener);
  for (std::uint32_t k = 0; k < packets.size(); ++k) {
    run.schedule(model::Nanoseconds{packets[k].time_ns}, model::EventKind::announcement_due, k);
  }
  while (!run.queue.empty()) {
    const model::Event event = run.queue.pop();
    run.now = event.time;
    if (event.kind == model::EventKind::announcement_due) {
      const vectors::ChannelPacket& listed = packets[event.subject];
      network.emit(listed.source, packet_of(listed, run.topology));
    } else {
      network.handle(event);
    }
    network.settle_drops();
  }
  return listener.arrived;
}

}  // namespace stormproof
