// Packets to the server, and its events in order.
#include "tests/model/fastdds/server_by_hand.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace stormproof::model::fastdds {

namespace {

Scenario of_clients(std::uint32_t clients, Discovery discovery) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(1, clients, 0);
  scenario.dds.implementation = ImplementationKind::fastdds;
  scenario.dds.discovery = discovery;
  scenario.dds.sedp.heartbeat_period = Nanoseconds{1'000'000'000};
  scenario.dds.sedp.nack_response_delay = Nanoseconds{1'000'000};
  scenario.dds.sedp.nack_suppression_duration = Nanoseconds{10'000'000};
  return scenario;
}

bool is_of_network(EventKind kind) {
  return class_of(kind) != EventClass::protocol || kind == EventKind::source_completion ||
         kind == EventKind::reception;
}

}  // namespace

ServerByHand::ServerByHand(std::uint32_t clients, Discovery discovery)
    : scenario_{of_clients(clients, discovery)},
      run_{scenario_, this, nullptr, SameHostPairs::with_server},
      network_{run_},
      protocol_{run_, network_} {
  network_.attach(protocol_);
}

void ServerByHand::receive(Packet&& packet, std::uint32_t from, bool to_writer) {
  packet.pair = to_writer ? run_.topology.pair_between(server_id(), from)
                          : run_.topology.pair_between(from, server_id());
  protocol_.received(packet, server_id());
}

void ServerByHand::registers(std::uint32_t i) {
  Packet packet;
  packet.kind = PacketKind::registration;
  receive(std::move(packet), i, false);
}

void ServerByHand::advertises(std::uint32_t i, Stream s, std::uint32_t d) {
  Packet packet;
  packet.kind = PacketKind::data;
  packet.stream = s;
  packet.descriptors.add(d / 64, std::uint64_t{1} << d % 64);
  receive(std::move(packet), i, false);
}

void ServerByHand::acknowledges(std::uint32_t j, std::uint32_t relay, std::int64_t base,
                                const Numbers& asks_for) {
  Relayed acknack;
  acknack.base = base;
  acknack.numbers = asks_for;
  Packet packet;
  packet.kind = PacketKind::relayed_acknack;
  packet.detail = relay;
  packet.relayed = std::make_shared<const Relayed>(std::move(acknack));
  receive(std::move(packet), j, true);
}

void ServerByHand::until(std::int64_t time_ns) {
  while (!run_.queue.empty() && run_.queue.next_time() <= Nanoseconds{time_ns}) {
    const Event event = run_.queue.pop();
    run_.now = event.time;
    if (!is_of_network(event.kind)) protocol_.handle(event);
  }
  run_.now = Nanoseconds{time_ns};
}

std::vector<ServerByHand::Sent> ServerByHand::sent() { return std::exchange(sent_, {}); }

template <class Is>
std::vector<ServerByHand::Sent> ServerByHand::those(Is is) {
  std::vector<Sent> list = sent();
  std::erase_if(list, [&](const Sent& one) { return !is(one.what); });
  return list;
}
std::vector<ServerByHand::Sent> ServerByHand::data() {
  return those([](const Relayed& what) { return what.has_data; });
}
std::vector<ServerByHand::Sent> ServerByHand::gaps() {
  return those([](const Relayed& what) { return !what.numbers.empty(); });
}
std::vector<ServerByHand::Sent> ServerByHand::heartbeats() {
  return those([](const Relayed& what) { return !what.has_data && what.numbers.empty(); });
}

std::vector<std::int64_t> ServerByHand::scheduled_for(EventKind kind) {
  return std::exchange(scheduled_[kind], {});
}

void ServerByHand::scheduled(std::uint64_t, Nanoseconds time, EventKind kind, std::uint32_t) {
  scheduled_[kind].push_back(time.count());
}

void ServerByHand::looped_back(const Packet& packet, std::uint32_t receiver) {
  if (packet.kind != PacketKind::relayed) return;
  sent_.push_back({run_.now.count(), receiver, packet.detail, *packet.relayed});
}

}  // namespace stormproof::model::fastdds
