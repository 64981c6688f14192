// Runs in which somebody decides what happens to each packet of one relation: how long it takes,
// how long it needs to leave its source, whether it is lost. So a schedule that a proof talks about
// becomes a scenario (`packet_delays`, `lost_packets`) that the simulator runs through the MSM
// machines. Witnesses of bounds, counterexamples and the bridge between the encodings and the
// machines are such runs.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/mutation.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::timeline {

/// A packet of the relation. Times count from the opening of the relation.
struct DirectedPacket {
  model::PacketKind kind{};
  std::uint32_t ordinal = 0;  ///< among those of its kind, by emission, from 0
  std::uint64_t number = 0;
  bool initial_acknack = false;
  bool asks = false;  ///< an ACKNACK with a bitmap that is not empty
  model::Nanoseconds emitted;
};

/// What happens to a packet; `leaves_after` is at most `one_way`.
struct Passing {
  model::Nanoseconds one_way;
  model::Nanoseconds leaves_after;
  bool lost = false;
};

/// Decides about the packets of the relation.
using Director = std::function<Passing(const DirectedPacket&)>;

struct Setting {
  model::DdsProfile dds;
  /// Of the relation: user publications; Fast DDS has its nine default ones besides.
  std::uint32_t descriptors = 1;
  /// When the writer's timer expires first, after the opening: 0 … τ_H. Not given: after τ_H. Needs
  /// `relation_opening: receiver` and the paper's implementation.
  std::optional<model::Nanoseconds> phase;
  /// When all endpoints of the publisher have been created, from the start of the run.
  /// (`implementation: fastdds` only)
  model::Nanoseconds endpoints_done;
  model::RunUntil run_until = model::RunUntil::completion;
  model::Nanoseconds time_limit{200'000'000'000};  ///< after the opening
};

struct DirectedRun {
  model::Scenario scenario;  ///< reproduces the run
  model::Nanoseconds opened;
  model::RunResult result;
  std::vector<DirectedPacket> packets;  ///< of the relation
  /// When the relation's last descriptor was received, after its opening.
  std::optional<model::Nanoseconds> completion;
  /// How many packets of this kind the relation had.
  [[nodiscard]] std::uint64_t count(model::PacketKind kind) const;
};

/// The run, under the mistakes of `mutation` if there are any. Nothing if the schedule cannot be
/// found, which only happens with mistakes that make a run endless.
[[nodiscard]] std::optional<DirectedRun> direct(const Setting& setting, const Director& director,
                                                const model::Mutation* mutation = nullptr);

}  // namespace stormproof::timeline
