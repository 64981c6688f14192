// Events one by one, and packets in words.
#include "tests/model/cyclone/bench.hpp"

#include <fmt/core.h>

namespace stormproof::model::cyclone {

namespace {

constexpr std::int64_t never_ns = 1'000'000 * ms;

std::string in_words(const Submessage& m) {
  switch (m.kind) {
    case Submessage::Kind::spdp:
      return m.directed ? "SPDP directed" : "SPDP";
    case Submessage::Kind::data:
      return fmt::format("DATA {}:{}", m.writer, m.sample + 1);
    case Submessage::Kind::heartbeat:
      return fmt::format("HEARTBEAT {}:{}{}", m.writer, m.sample, m.directed ? " directed" : "");
    case Submessage::Kind::acknack:
      break;
  }
  std::string text = fmt::format("ACKNACK {}:{}", m.writer, m.sample + 1);
  m.bitmap.for_each([&](std::uint32_t d) { text += fmt::format(" {}", d + 1); });
  return m.initial ? text + " initial" : text;
}

}  // namespace

Bench::Bench(std::uint32_t peers, std::int64_t step_ns, std::uint32_t publications) {
  for (std::uint32_t i = 0; i <= peers; ++i) {
    Participant p;
    p.host = HostId{i == 0 ? 0U : 1U};
    p.publications = publications;
    p.endpoints_done = Nanoseconds{step_ns * (17 + publications)};
    scenario_.deployment.participants.push_back(p);
  }
  scenario_.deployment.send_time = Nanoseconds{0};
  scenario_.deployment.loopback_delay = Nanoseconds{never_ns};
  scenario_.dds.implementation = ImplementationKind::cyclone;
  scenario_.dds.allow_multicast = AllowMulticast::spdp;
  scenario_.dds.spdp.period = Nanoseconds{8'000 * ms};
  scenario_.wireless.kind = ServiceKind::constant_delay;
  scenario_.wireless.one_way = Nanoseconds{never_ns};
  scenario_.time_limit = Nanoseconds{never_ns};
  scenario_.run_until = RunUntil::time_limit;
}

void Bench::start() {
  run_ = std::make_unique<RunState>(scenario_, this, nullptr, SameHostPairs::included);
  network_ = std::make_unique<Network>(*run_);
  protocol_ = std::make_unique<Protocol>(*run_, *network_);
  network_->attach(*protocol_);
  protocol_->start();
}

void Bench::step() {
  const Event event = run_->queue.pop();
  run_->now = event.time;
  if (class_of(event.kind) == EventClass::protocol) protocol_->handle(event);
}

void Bench::run_to(std::int64_t time_ns) {
  while (!run_->queue.empty() && run_->queue.next_time() <= Nanoseconds{time_ns}) step();
  run_->now = Nanoseconds{time_ns};
}

void Bench::receive(std::uint32_t sender, std::uint32_t receiver,
                    std::vector<Submessage> contents) {
  Packet packet;
  packet.kind = PacketKind::rtps_message;
  packet.pair = run_->topology.pair_between(sender, receiver);
  packet.submessages = std::make_shared<const std::vector<Submessage>>(std::move(contents));
  protocol_->received(packet, receiver);
}

void Bench::introduce(std::uint32_t i, std::uint32_t j) {
  std::vector<Submessage> one;
  one.push_back(announcement_of(i));
  receive(i, j, std::move(one));
  std::vector<Submessage> other;
  other.push_back(announcement_of(j));
  receive(j, i, std::move(other));
}

std::vector<Sent> Bench::sent_by(std::uint32_t source, bool all) {
  std::vector<Sent> list;
  for (const auto& [who, sent] : all ? sent_ : sent_of_streams_) {
    if (who == source) list.push_back(sent);
  }
  sent_.clear();
  sent_of_streams_.clear();
  return list;
}

void Bench::emitted(const Packet& packet, std::uint32_t source,
                    std::span<const std::uint32_t> destinations) {
  Sent sent{
      run_->now.count(), packet.multicast() ? group : destinations[0], packet.payload_bytes, {}};
  Sent of_streams = sent;
  for (const Submessage& m : *packet.submessages) {
    sent.messages.push_back(in_words(m));
    const bool of_stream = m.kind != Submessage::Kind::spdp && m.writer <= writer::subscriptions;
    if (of_stream) of_streams.messages.push_back(in_words(m));
  }
  sent_.emplace_back(source, sent);
  if (!of_streams.messages.empty()) sent_of_streams_.emplace_back(source, of_streams);
}

Submessage announcement_of(std::uint32_t participant) {
  Submessage m;
  m.kind = Submessage::Kind::spdp;
  m.participant = participant;
  m.directed = true;  // nobody answers
  return m;
}

Submessage heartbeat_of(std::uint32_t participant, std::uint32_t writer, std::uint32_t announced,
                        std::int64_t count, bool directed) {
  Submessage m;
  m.kind = Submessage::Kind::heartbeat;
  m.participant = participant;
  m.writer = writer;
  m.sample = announced;
  m.count = count;
  m.directed = directed;
  return m;
}

Submessage data_of(std::uint32_t participant, std::uint32_t writer, std::uint32_t sample) {
  Submessage m;
  m.kind = Submessage::Kind::data;
  m.participant = participant;
  m.writer = writer;
  m.sample = sample - 1;
  return m;
}

Submessage request_for(std::uint32_t participant, std::uint32_t writer,
                       std::vector<std::uint32_t> missing, std::int64_t count) {
  Submessage m;
  m.kind = Submessage::Kind::acknack;
  m.participant = participant;
  m.writer = writer;
  m.count = count;
  m.sample = missing.empty() ? 0 : missing.front() - 1;
  for (const std::uint32_t sample : missing) {
    m.bitmap.add((sample - 1) / 64, std::uint64_t{1} << (sample - 1) % 64);
  }
  return m;
}

}  // namespace stormproof::model::cyclone
