// One real Fast DDS participant with the endpoints of a ROS 2 node, over UDP and one interface
// only.
#pragma once

#include <cstdint>
#include <functional>

#include "options.hpp"
#include "progress.hpp"

namespace stormproof::live {

/// When the participant came into being, in ns since 1970.
struct Schedule {
  std::int64_t created_ns = 0;         ///< its creation (simultaneous: its enabling) began
  std::int64_t endpoints_done_ns = 0;  ///< all its endpoints exist (simultaneous: are enabled)
};

/// The Discovery Server, which lives as long as the process.
void create_server(const Options& options);

/// Creates the participant and its endpoints. `wait_for_start` returns at the start instant: it is
/// called first, or, if the start is simultaneous, when all endpoints exist, disabled and
/// unannounced. What is created lives as long as the process. Throws std::runtime_error if Fast DDS
/// refuses.
Schedule create_participant(const Options& options, Progress& progress,
                            const std::function<void()>& wait_for_start);

}  // namespace stormproof::live
