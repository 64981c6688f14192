// The timeline of a whole relation with one descriptor, on numbers: which HEARTBEATs are sent,
// which ACKNACKs answer them, what is repaired and when the descriptor arrives. It is the encoding
// of checker/engines/timeline/exchange.hpp evaluated on plain values, and answers to the same
// director as a run of the machines (checker/engines/timeline/directed_run.hpp): the two must
// agree.
#pragma once

#include "checker/engines/timeline/directed_run.hpp"

namespace stormproof::timeline {

struct Prediction {
  std::optional<model::Nanoseconds> received;  ///< after the opening
  std::uint64_t data = 0;                      ///< how often the descriptor is generated
  std::uint64_t heartbeats = 0;
  std::uint64_t acknacks = 0;
  std::optional<model::Nanoseconds> last_packet;  ///< emission of the last one

  bool operator==(const Prediction&) const = default;
};

/// What the encoding says, up to the time limit of the setting. For the paper's implementation with
/// one descriptor, periodic single timers, `relation_opening: receiver`, delays of at least 1 ns,
/// and with a phase `heartbeat_recipients: unacknowledged`.
[[nodiscard]] Prediction predict(const Setting& setting, const Director& director);

/// The same about a run, which must have `run_until: time_limit`.
[[nodiscard]] Prediction observe(const DirectedRun& run);

}  // namespace stormproof::timeline
