// The observer that turns the emissions of a run into frames: one RTPS message for each packet that
// leaves a host, with the content that the implementation would have written, at its emission. What
// stays on a host never reaches the link and is left out, but for the counts, in which its writers
// and readers have it.
//
// What a packet of the model does not say, because no rule depends on it, is derived here: entity
// ids, counts of HEARTBEATs and ACKNACKs, and whether a message names its destination (the model
// knows that by its size).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "checker/evidence/capture/bytes.hpp"
#include "model/probe.hpp"
#include "model/scenario.hpp"

namespace stormproof::capture {

/// 2000-01-01T00:00:00Z, in nanoseconds since 1970: time 0 of a run in its capture.
inline constexpr std::int64_t simulated_epoch_ns = 946'684'800'000'000'000;

/// Vendor of the participants of an implementation that no vendor has, as the paper's: "SP".
inline constexpr std::uint16_t simulated_vendor = 0x5350;

class CaptureProbe final : public model::Probe {
 public:
  /// Takes the next bytes of the file.
  using Sink = std::function<void(Bytes)>;

  /// Gives the file header to the sink at once; from then on every call ends with a whole frame.
  /// The scenario must outlive the probe.
  CaptureProbe(Sink sink, const model::Scenario& scenario);
  ~CaptureProbe() override;

  void run_started(const model::Topology& topology) override;
  void event_started(const model::Event& event) override;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stormproof::capture
