// Fingerprints are chained multiplications; two runs of millions of events that differ and have the
// same ones are not to be expected.
#include "checker/experiments/diff/run_log.hpp"

#include <bit>
#include <utility>

#include <fmt/format.h>

#include "model/trace/event_subject.hpp"
#include "model/trace/packet_text.hpp"
#include "model/trace/perfetto_labels.hpp"

namespace stormproof::diff {

namespace {

using model::trace::Subject;

/// The finalizer of SplitMix64 over a running value.
void mix(std::uint64_t& hash, std::uint64_t value) {
  std::uint64_t x = hash * 0x9e3779b97f4a7c15U + value + 0x632be59bd9b4e019U;
  x = (x ^ x >> 30U) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27U) * 0x94d049bb133111ebU;
  hash = x ^ x >> 31U;
}

/// Names of machines, events and states are constants of the program: their place says it all, and
/// fingerprints are compared within one process only.
void mix(std::uint64_t& hash, std::string_view name) {
  mix(hash, std::uint64_t{std::bit_cast<std::uintptr_t>(name.data())});
}

void mix(std::uint64_t& hash, model::Nanoseconds time) {
  mix(hash, static_cast<std::uint64_t>(time.count()));
}

bool names_a_packet(model::EventKind kind) {
  return model::trace::subject_of(kind) == Subject::packet;
}

}  // namespace

void Fingerprints::event_started(const model::Event& event) {
  now_ = event.time;
  current_ = 0;
  mix(current_, event.time);
  mix(current_, static_cast<std::uint64_t>(event.kind));
  if (!names_a_packet(event.kind)) mix(current_, event.subject);
}

void Fingerprints::transition(const model::Transition& fired) {
  if (fired.before == fired.after) return;
  mix(current_, fired.machine.machine);
  mix(current_, fired.machine.subject);
  mix(current_, fired.event);
  mix(current_, fired.before);
  mix(current_, fired.after);
  mix(current_, fired.first_word);
  mix(current_, fired.descriptors);
}

void Fingerprints::add_packet(const model::Packet& packet, std::uint32_t source,
                              std::span<const std::uint32_t> destinations) {
  std::uint64_t hash = 0;
  mix(hash, now_);
  mix(hash, source);
  mix(hash, destinations.size());
  for (const std::uint32_t destination : destinations) mix(hash, destination);
  mix(hash, static_cast<std::uint64_t>(packet.kind));
  mix(hash, static_cast<std::uint64_t>(packet.stream));
  mix(hash, packet.payload_bytes);
  mix(hash, packet.detail);
  mix(hash, packet.heartbeats);
  mix(hash, packet.initial_acknack ? 1U : 0U);
  mix(hash, packet.carries_initial ? 1U : 0U);
  for (std::uint32_t k = packet.descriptors.first_word(); k < packet.descriptors.end_word(); ++k) {
    mix(hash, k);
    mix(hash, packet.descriptors.word(k));
  }
  packets.push_back(hash);
}

void Fingerprints::emitted(const model::Packet& packet, std::uint32_t source,
                           std::span<const std::uint32_t> destinations) {
  add_packet(packet, source, destinations);
}

void Fingerprints::looped_back(const model::Packet& packet, std::uint32_t receiver) {
  add_packet(packet, receiver, {});
  mix(packets.back(), packet.pair);
}

void Fingerprints::arrived(const model::Packet& packet, bool lost) {
  mix(current_, packet.number);
  mix(current_, lost ? 1U : 0U);
}

void Fingerprints::received(const model::Packet& packet, std::uint32_t receiver) {
  mix(current_, packet.number);
  mix(current_, receiver);
}

bool SentPacket::is_like(const SentPacket& other) const {
  const bool control = kind == model::PacketKind::user_heartbeat ||
                       kind == model::PacketKind::user_acknack || kind == model::PacketKind::lookup;
  return source == other.source && destinations == other.destinations && kind == other.kind &&
         stream == other.stream && initial_acknack == other.initial_acknack &&
         (!control || detail == other.detail);
}

RunLog::RunLog(std::uint64_t first_packet, std::uint64_t first_event, std::size_t most)
    : first_packet_{first_packet}, first_event_{first_event}, most_{most} {}

void RunLog::event_started(const model::Event& event) {
  event_ = event;
  logs_event_ = processed_ >= first_event_ && events.size() < most_;
  if (!logs_event_) return;
  events.push_back({event.time, event.kind, names_a_packet(event.kind) ? 0 : event.subject, {}});
}

void RunLog::transition(const model::Transition& fired) {
  if (!logs_event_ || fired.before == fired.after) return;
  events.back().changes.push_back(
      fmt::format("{} {} → {}", fired.machine.machine, fired.before, fired.after));
}

void RunLog::add_packet(const model::Packet& packet, std::uint32_t source,
                        std::span<const std::uint32_t> destinations, std::string label) {
  if (emitted_++ < first_packet_ || packets.size() == most_) return;
  SentPacket sent;
  sent.event = processed_;
  sent.time = event_.time;
  sent.source = source;
  sent.destinations.assign(destinations.begin(), destinations.end());
  sent.kind = packet.kind;
  sent.stream = packet.stream;
  sent.detail = packet.detail;
  sent.initial_acknack = packet.initial_acknack;
  sent.bytes = packet.payload_bytes;
  sent.descriptors.resize(packet.descriptors.end_word());
  for (std::uint32_t k = 0; k < sent.descriptors.size(); ++k) {
    sent.descriptors[k] = packet.descriptors.word(k);
  }
  sent.label = std::move(label);
  packets.push_back(std::move(sent));
}

void RunLog::emitted(const model::Packet& packet, std::uint32_t source,
                     std::span<const std::uint32_t> destinations) {
  const std::span<const std::uint32_t> named =
      packet.multicast() ? std::span<const std::uint32_t>{} : destinations;
  const std::size_t known = packets.size();
  add_packet(packet, source, named, model::trace::packet_label(packet));
  if (packets.size() == known) return;
  for (std::uint64_t copy = 0; copy < packet.copies; ++copy) {
    packets.back().numbers.push_back(packet.number + copy);
  }
}

void RunLog::looped_back(const model::Packet& packet, std::uint32_t receiver) {
  const std::uint32_t source = model::trace::packet_ends(packet, *topology_).from;
  // First transmissions are not counted on the way to a participant of the same host.
  const bool data = packet.kind == model::PacketKind::data;
  const char* const label = !data                      ? model::trace::packet_label(packet)
                            : packet.carries_heartbeat ? "DATA+HEARTBEAT"
                                                       : "DATA";
  add_packet(packet, source, {&receiver, 1}, label);
}

}  // namespace stormproof::diff
