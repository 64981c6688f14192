// One run as a film: at equal distances in time, what has been sent, what waits, and who knows how
// much of whom.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/probe.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::page {

struct Picture {
  model::Nanoseconds time;
  std::uint64_t events = 0;   ///< that have been processed until then
  std::uint64_t missing = 0;  ///< required deliveries that have not happened
  std::uint64_t waiting = 0;  ///< most fragments that waited for the channel since the last one
  std::uint64_t backlog = 0;  ///< and most packets that waited for their source queues
  std::array<std::uint64_t, model::traffic_class_count> sent{};  ///< packets by class, until then
};

struct Recording {
  model::RunResult result;
  std::vector<Picture> pictures;  ///< the last one is the end of the run
  /// For each picture, source and destination, in this order of digits: 0 nothing … 255
  /// everything that the source has is known to the destination.
  std::vector<std::uint8_t> known;
};

/// At most `pictures` of them, at least one.
[[nodiscard]] Recording record(const model::Scenario& scenario, std::size_t pictures);

}  // namespace stormproof::page
