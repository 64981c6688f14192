// storm.free-threshold as a theorem: the exact condition on the delays under which a descriptor can
// be sent again although nothing is lost. Found by quantifier elimination over all delays, and then
// proved without it.
#pragma once

#include <string>
#include <vector>

#include "checker/engines/timeline/theorem.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::timeline {

/// Which part of the theorem.
enum class RepairCause : unsigned char {
  heartbeat,         ///< pushed DATA that an ACKNACK to a HEARTBEAT calls missing
  initial_acknack,   ///< pushed DATA that the reader's first own ACKNACK calls missing
  in_order,          ///< as `heartbeat`, but no HEARTBEAT overtakes the DATA
  constant_delay,    ///< as `initial_acknack`, but every packet takes the same time
  second_request,    ///< pulled DATA that is requested once more
  fastdds_heartbeat  ///< as `heartbeat`, by Fast DDS's writer, which suppresses from the start
};

/// What was eliminated and proved.
struct EliminatedCondition {
  RepairCause cause{};
  std::string eliminated;  ///< by the solver, over the delays
  std::string simplified;  ///< the same, proved to be
};

/// Whether the claimed conditions are moved by this many nanoseconds, to show that they cannot be.
struct ThresholdShift {
  int nanoseconds = 0;
};

/// Decides all parts.
std::vector<EliminatedCondition> prove_free_threshold(Theorem& theorem,
                                                      const ThresholdShift& shift = {});

/// Δ*: at delays up to it no descriptor is sent again, without loss. Nothing: at no delay.
struct FreeThreshold {
  bool exists = true;  ///< false: none above 0
  bool unlimited = false;
  model::Nanoseconds delta;
  std::string formula;
};
/// For the paper's writer. `constant_delay`: every packet takes the same time.
[[nodiscard]] FreeThreshold free_threshold(const model::SedpProfile& sedp, bool constant_delay);

}  // namespace stormproof::timeline
