// Drawn profiles and schedules for the bridge between encodings and machines: few nanoseconds each,
// so that ties are likely.
#pragma once

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "checker/engines/bounds/completion_bound.hpp"
#include "checker/engines/timeline/directed_run.hpp"

namespace stormproof::timeline {

inline model::Nanoseconds drawn_time(std::int64_t low, std::int64_t high) {
  return model::Nanoseconds{*rc::gen::inRange<std::int64_t>(low, high + 1)};
}

/// Timers of any kind of profile that the encoding covers.
inline model::SedpProfile drawn_timers() {
  model::SedpProfile sedp;
  sedp.piggyback = model::Piggyback::off;
  sedp.heartbeat_period = drawn_time(1, 40);
  sedp.heartbeat_response_delay = drawn_time(0, 8);
  sedp.nack_response_delay = drawn_time(0, 8);
  sedp.nack_suppression_duration = drawn_time(0, *rc::gen::element(8, 60));
  sedp.initial_acknack_delay = drawn_time(0, *rc::gen::element(0, 30));
  sedp.initial_acknack_interval = *rc::gen::element(model::InitialAckNackInterval::doubling,
                                                    model::InitialAckNackInterval::constant);
  sedp.initial_acknack =
      *rc::gen::element(model::InitialAckNackReply::bitmap, model::InitialAckNackReply::heartbeat,
                        model::InitialAckNackReply::none);
  sedp.initial_data = *rc::gen::element(model::InitialData::push, model::InitialData::pull);
  sedp.acknowledge = *rc::gen::element(model::Acknowledge::bitmap, model::Acknowledge::prefix);
  sedp.heartbeat_recipients = *rc::gen::element(model::HeartbeatRecipients::unacknowledged,
                                                model::HeartbeatRecipients::matched);
  return sedp;
}

/// What a network with delays from 1 ns to `delta` does: a pure function of the packet.
struct DrawnNetwork {
  std::int64_t delta = 1;
  std::uint32_t seed = 0;
  std::uint32_t lost_percent = 0;
  std::uint32_t may_be_lost = 5;  ///< of each kind, so many packets from the first on

  [[nodiscard]] static DrawnNetwork draw() {
    return {*rc::gen::inRange<std::int64_t>(1, 13), *rc::gen::arbitrary<std::uint32_t>(),
            *rc::gen::inRange<std::uint32_t>(0, 50), 5};
  }

  Passing operator()(const DirectedPacket& packet) const {
    std::uint64_t state = seed + 0x9E3779B97F4A7C15ULL * (packet.ordinal + 1) +
                          0xBF58476D1CE4E5B9ULL * (static_cast<std::uint64_t>(packet.kind) + 1);
    const auto next = [&state](std::uint64_t bound) {
      state ^= state >> 31;
      state *= 0x94D049BB133111EBULL;
      state ^= state >> 29;
      return static_cast<std::int64_t>(state % bound);
    };
    Passing passing;
    const auto range = static_cast<std::uint64_t>(delta);
    passing.one_way = model::Nanoseconds{next(3) == 0 ? delta : 1 + next(range)};
    passing.leaves_after =
        model::Nanoseconds{next(static_cast<std::uint64_t>(passing.one_way.count()) + 1)};
    passing.lost = next(100) < lost_percent && packet.ordinal < may_be_lost;
    return passing;
  }

  /// Packets of the run that are lost before its relation has everything.
  [[nodiscard]] unsigned losses(const DirectedRun& run) const {
    return static_cast<unsigned>(
        std::ranges::count_if(run.packets, [&](const DirectedPacket& packet) {
          return (*this)(packet).lost && (!run.completion || packet.emitted <= *run.completion);
        }));
  }
};

/// Runs the property so many times; RC_PARAMS decides about the seed.
#define STORMPROOF_DRAWN(description, ...) EXPECT_TRUE(rc::check(description, __VA_ARGS__))

}  // namespace stormproof::timeline
