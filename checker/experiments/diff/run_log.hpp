// What a participant does in a run, as one list of packets and one of events, for the comparison of
// two runs: as fingerprints to find the place, and in full around the place to describe it. Numbers
// that mean nothing outside a run (insertion numbers, packet slots, cycle tokens) stay out.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"

namespace stormproof::diff {

/// Everything that happens in a run, as 64-bit fingerprints.
class Fingerprints final : public model::Probe {
 public:
  void event_started(const model::Event& event) override;
  void event_finished(const model::Depths&) override { events.push_back(current_); }
  void transition(const model::Transition& fired) override;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override;
  void arrived(const model::Packet& packet, bool lost) override;
  void received(const model::Packet& packet, std::uint32_t receiver) override;

  std::vector<std::uint64_t> packets;  ///< in the order of their emission
  std::vector<std::uint64_t> events;   ///< without the packets that they emit

 private:
  void add_packet(const model::Packet& packet, std::uint32_t source,
                  std::span<const std::uint32_t> destinations);

  model::Nanoseconds now_;
  std::uint64_t current_ = 0;
};

/// A packet that joins the backlog of its source, or goes to a participant of the same host.
struct SentPacket {
  std::vector<std::uint64_t> numbers;  ///< none if it stays on its host
  std::uint64_t event = 0;
  model::Nanoseconds time;
  std::uint32_t source = 0;
  std::vector<std::uint32_t> destinations;  ///< empty: everybody
  model::PacketKind kind{};
  model::Stream stream{};
  std::uint32_t detail = 0;  ///< announced descriptors, base of an ACKNACK, control-only relation
  bool initial_acknack = false;
  std::uint32_t bytes = 0;
  std::vector<std::uint64_t> descriptors;
  std::string label;  ///< "ACKNACK"

  /// Whether it is the same deed, at whatever time and with whatever content.
  [[nodiscard]] bool is_like(const SentPacket& other) const;
};

/// An event and the states that it changes.
struct LoggedEvent {
  model::Nanoseconds time;
  model::EventKind kind{};
  std::uint32_t subject = 0;         ///< not of packets, whose slots mean nothing
  std::vector<std::string> changes;  ///< "InitialAckNack Dormant → Waiting"
};

/// The packets from a given one on, and the events from a given one on, so many of each.
class RunLog final : public model::Probe {
 public:
  RunLog(std::uint64_t first_packet, std::uint64_t first_event, std::size_t most);

  void run_started(const model::Topology& topology) override { topology_ = &topology; }
  void event_started(const model::Event& event) override;
  void event_finished(const model::Depths&) override { ++processed_; }
  void transition(const model::Transition& fired) override;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override;

  std::vector<SentPacket> packets;
  std::vector<LoggedEvent> events;

  [[nodiscard]] std::uint64_t processed() const { return processed_; }

 private:
  void add_packet(const model::Packet& packet, std::uint32_t source,
                  std::span<const std::uint32_t> destinations, std::string label);

  std::uint64_t first_packet_;
  std::uint64_t first_event_;
  std::size_t most_;
  const model::Topology* topology_ = nullptr;  // while the run lasts
  std::uint64_t emitted_ = 0;
  std::uint64_t processed_ = 0;
  model::Event event_;
  bool logs_event_ = false;
};

}  // namespace stormproof::diff
