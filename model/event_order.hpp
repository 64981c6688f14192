// The order of events, (time, class, insertion number), in one body: the queue executes it, and the
// checker proves over solver expressions that it is a strict total order. Class and insertion
// number travel packed in one number, which orders like the pair.
#pragma once

#include <cstdint>

namespace stormproof::model {

/// An event's class above its insertion number, which must be below 2^62.
template <class Number>
constexpr Number packed_order(const Number& event_class, const Number& insertion) {
  return event_class * Number(std::uint64_t{1} << 62) + insertion;
}

/// Whether an event at `time` with packed order `order` is to be processed before another one.
template <class Time, class Number>
constexpr auto is_before(const Time& time, const Number& order, const Time& other_time,
                         const Number& other_order) {
  return time < other_time || (time == other_time && order < other_order);
}

}  // namespace stormproof::model
