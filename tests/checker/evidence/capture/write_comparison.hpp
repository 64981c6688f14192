// What a capture of a run has to agree with the run about, as functions that name the first
// difference: counts, deployment and required keys on the one hand, every datagram on the other.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "model/engine/packet.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/probe.hpp"

namespace stormproof::capture::testing {

/// A packet that left a host for one destination, as the simulator reports it.
struct Emission {
  model::PacketKind kind{};
  model::Stream stream{};
  std::int64_t time_ns = 0;
  std::uint32_t payload_bytes = 0;
  std::uint32_t source = 0;
  std::uint32_t destination = 0;  ///< not of a multicast packet
  std::vector<std::uint32_t> descriptors{};
  std::uint32_t detail = 0;
  std::uint32_t heartbeats = 0;
  bool initial_acknack = false;
  bool to_nobody = false;
  std::shared_ptr<const model::Relayed> relayed{};  ///< by a server, or to it
};

class EmissionRecorder final : public model::Probe {
 public:
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;
  [[nodiscard]] const std::vector<Emission>& emissions() const { return emissions_; }

 private:
  std::vector<Emission> emissions_;
};

/// A run that is written as a capture, and what its packets are.
struct RecordedCapture {
  SimulatedCapture capture;
  std::vector<Emission> emissions;
};
[[nodiscard]] RecordedCapture recorded(const model::Scenario& scenario);

/// The capture as `capture summarize` reads it; fails the test if it cannot be read.
[[nodiscard]] Conversation conversation_in(const SimulatedCapture& capture);

/// Counts, traffic of control-only relations, topology, required keys. Empty: they agree.
[[nodiscard]] std::string difference(const model::Scenario& scenario, const model::RunResult& run,
                                     const Conversation& conversation);

/// Every emission is one datagram, in order: time, size, addresses, submessages. Empty: it is.
[[nodiscard]] std::string difference(const model::Scenario& scenario,
                                     const std::vector<Emission>& emissions,
                                     const Conversation& conversation);

}  // namespace stormproof::capture::testing
