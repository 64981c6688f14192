// The one event queue: the next event is the least (time, class, insertion number). The classes
// make the order of same-time events what the model asks for: a reception comes before any protocol
// decision of that instant, and a channel starts serving after both (specs/guide/model.md, "Events
// and their order").
//
// Nearly every kind of event is scheduled at a constant distance from now, so its events arrive in
// ascending order. Each kind therefore has a lane, a plain queue; what would break the order of its
// lane goes to a common heap. The next event is the least of the lane heads and the heap's top:
// exact for any schedule, and fast for the usual one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "model/engine/ring_buffer.hpp"
#include "model/event.hpp"
#include "model/units.hpp"

namespace stormproof::model {

class EventQueue {
 public:
  /// Inserts an event with the next insertion number; returns that number.
  std::uint64_t schedule(Nanoseconds time, EventKind kind, std::uint32_t subject,
                         std::uint32_t detail = 0) {
    return schedule_as(class_of(kind), time, kind, subject, detail);
  }

  /// The same in a class that need not be the one of its kind: a deliberate mistake.
  std::uint64_t schedule_as(EventClass event_class, Nanoseconds time, EventKind kind,
                            std::uint32_t subject, std::uint32_t detail) {
    const std::uint64_t insertion = inserted_++;
    const std::uint64_t order = static_cast<std::uint64_t>(event_class) << 62 | insertion;
    const Event event{time, order, subject, detail, kind};
    const auto lane = static_cast<std::size_t>(kind);
    if (lanes_[lane].empty()) {
      lanes_[lane].push_back(event);
      enter(lane, event);
    } else if (lanes_[lane].back().before(event)) {
      lanes_[lane].push_back(event);
    } else {
      push_heap(event);
    }
    ++size_;
    idle_ += is_idle(kind) ? 1U : 0U;
    return insertion;
  }

  /// An event with the next insertion number that is not inserted.
  Event make(Nanoseconds time, EventKind kind, std::uint32_t subject) {
    const std::uint64_t order = static_cast<std::uint64_t>(class_of(kind)) << 62 | inserted_++;
    return {time, order, subject, 0, kind};
  }

  /// The insertion number of the next event.
  [[nodiscard]] std::uint64_t next_insertion() const { return inserted_; }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Whether all that is left are announcements, and looks at whether there were any.
  [[nodiscard]] bool is_quiet() const { return size_ == idle_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Time of the next event. The queue must not be empty.
  [[nodiscard]] Nanoseconds next_time() const { return ranking_[0].time; }

  /// Removes and returns the next event. The queue must not be empty.
  Event pop() {
    --size_;
    const std::size_t lane = ranking_[0].lane;
    if (lane == heap_lane) {
      const Event event = pop_heap();
      idle_ -= is_idle(event.kind) ? 1U : 0U;
      return event;
    }
    idle_ -= is_idle(static_cast<EventKind>(lane)) ? 1U : 0U;
    RingBuffer<Event>& events = lanes_[lane];
    const Event event = events.front();
    events.pop_front();
    leave_first();
    if (!events.empty()) enter(lane, events.front());
    return event;
  }

 private:
  static constexpr std::size_t heap_lane = event_kind_count;

  /// The first event of a lane that is not empty.
  struct Head {
    Nanoseconds time;
    std::uint64_t order = 0;
    std::size_t lane = 0;
  };

  static constexpr bool is_idle(EventKind kind) {
    return kind == EventKind::announcement_due || kind == EventKind::lease_check;
  }
  static bool later(const Event& a, const Event& b) { return b.before(a); }

  /// Inserts the lane with first event `event` into the ranking, which few others precede as a
  /// rule.
  void enter(std::size_t lane, const Event& event) {
    std::size_t k = ranked_++;
    for (; k > 0; --k) {
      const Head& other = ranking_[k - 1];
      if (other.time < event.time || (other.time == event.time && other.order < event.order)) break;
      ranking_[k] = other;
    }
    ranking_[k] = {event.time, event.order, lane};
  }
  void leave_first() { leave(0); }
  void leave(std::size_t k) {
    --ranked_;
    for (; k < ranked_; ++k) ranking_[k] = ranking_[k + 1];
  }

  void push_heap(const Event& event) {
    const bool first = heap_.empty() || event.before(heap_.front());
    heap_.push_back(event);
    std::push_heap(heap_.begin(), heap_.end(), later);
    if (!first) return;
    for (std::size_t k = 0; k < ranked_; ++k) {
      if (ranking_[k].lane == heap_lane) leave(k);
    }
    enter(heap_lane, event);
  }

  Event pop_heap() {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Event event = heap_.back();
    heap_.pop_back();
    leave_first();
    if (!heap_.empty()) enter(heap_lane, heap_.front());
    return event;
  }

  std::array<RingBuffer<Event>, event_kind_count> lanes_;
  std::vector<Event> heap_;
  std::array<Head, event_kind_count + 1> ranking_;  // heads of the lanes in use, in ascending order
  std::size_t ranked_ = 0;
  std::size_t size_ = 0;
  std::size_t idle_ = 0;  ///< of them, those that go on for ever
  std::uint64_t inserted_ = 0;
};

}  // namespace stormproof::model
