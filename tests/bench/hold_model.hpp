// The hold model of event queues: one "hold" takes the least event out and puts it in again at a
// later time, so the queue keeps its length. Either the delay is drawn anew each time, or each
// event has one of the few constant delays that timers have, which is what the queue is made for.
// Any queue can be held; this header knows none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <random>

namespace hold_model {

inline constexpr std::array<std::int64_t, 8> constant_delays{
    10'000,     100'000,     330'000,       70'000'000,
    10'000'000, 100'000'000, 1'000'000'000, 3'000'000'000};  // ns

inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Holds per second of processor time. `Queue` has put(time, kind) and take(kind), which sets the
/// kind and returns the time.
template <class Queue>
double holds_per_second(std::size_t length, std::size_t holds, bool constant) {
  Queue queue;
  std::mt19937_64 random{1};
  const auto delay = [&](unsigned kind) {
    return constant ? constant_delays[kind] : static_cast<std::int64_t>(random() % 2'000'000);
  };
  for (std::size_t k = 0; k < length; ++k) {
    const auto kind = static_cast<unsigned>(k % constant_delays.size());
    // Those of one kind are spread over its delay, in ascending order.
    const auto share = static_cast<std::int64_t>(k + 1);
    const auto total = static_cast<std::int64_t>(length + 1);
    queue.put(constant ? constant_delays[kind] / total * share : delay(kind), kind);
  }
  const auto hold = [&](std::size_t times) {
    for (std::size_t k = 0; k < times; ++k) {
      unsigned kind = 0;
      const std::int64_t now = queue.take(kind);
      queue.put(now + delay(kind), kind);
    }
  };
  hold(length < holds ? length : holds);  // until it has settled
  const double start = processor_seconds();
  hold(holds);
  return static_cast<double>(holds) / (processor_seconds() - start);
}

}  // namespace hold_model
