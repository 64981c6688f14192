// What a run does, as one number: two runs that differ in anything that an observer hears differ in
// it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "model/engine/packet.hpp"
#include "model/engine/submessage.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/probe.hpp"

namespace stormproof::props {

/// A digest of what a run does, without the numbers that cancelled events have.
class RunDigest : public model::Probe {
 public:
  void event_started(const model::Event& event) override {
    note(static_cast<std::uint64_t>(event.time.count()));
    note(static_cast<std::uint64_t>(event.kind));
    note(event.subject);
  }
  void event_finished(const model::Depths& depths) override { note(depths.missing); }
  void transition(const model::Transition& fired) override {
    for (const std::string_view text : {fired.machine.machine, fired.event, fired.after}) {
      note(std::hash<std::string_view>{}(text));
    }
    note(fired.machine.subject);
    note(fired.first_word);
    note(fired.descriptors);
  }
  void scheduled(std::uint64_t, model::Nanoseconds time, model::EventKind kind,
                 std::uint32_t subject) override {
    note(static_cast<std::uint64_t>(time.count()));
    note(static_cast<std::uint64_t>(kind));
    note(subject);
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    note_packet(packet);
  }
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override {
    note_packet(packet);
    note(receiver);
  }
  std::uint64_t digest = 0;

 private:
  void note(std::uint64_t what) { digest = (digest ^ what) * 1'099'511'628'211U + 1; }
  void note_packet(const model::Packet& packet) {
    note(static_cast<std::uint64_t>(packet.kind));
    note(packet.relation());
    note(packet.detail);
    note(packet.copies);
    note(packet.carries_heartbeat ? 1 : 0);
    packet.descriptors.for_each([&](std::uint32_t d) { note(d); });
    if (packet.relayed != nullptr) note_relayed(*packet.relayed);
    if (packet.submessages == nullptr) return;
    note(packet.payload_bytes);
    for (const model::Submessage& each : *packet.submessages) note_submessage(each);
  }
  void note_submessage(const model::Submessage& submessage) {
    note(static_cast<std::uint64_t>(submessage.kind));
    note(submessage.writer);
    note(submessage.sample);
    note(static_cast<std::uint64_t>(submessage.count));
    note((submessage.directed ? 2U : 0U) + (submessage.initial ? 1U : 0U));
    submessage.bitmap.for_each([&](std::uint32_t d) { note(d); });
  }
  void note_relayed(const model::Relayed& relayed) {
    note(relayed.participant);
    note(relayed.descriptor);
    for (const std::int64_t number : {relayed.number, relayed.first, relayed.last, relayed.base}) {
      note(static_cast<std::uint64_t>(number));
    }
    for (const std::int64_t number : relayed.numbers) note(static_cast<std::uint64_t>(number));
  }
};

}  // namespace stormproof::props
