// The one event queue: the next event is the least (time, class, insertion number). The classes
// make the order of same-time events what the model asks for: a reception comes before any protocol
// decision of that instant, and a channel starts serving after both (specs/guide/model.md, "Events
// and their order").
//
// Nearly every kind of event is scheduled at a constant distance from now, so its events arrive in
// ascending order. Each kind therefore has a lane: its first event stands in a short ranking, the
// others in a plain queue behind it; what would break the order of its lane goes to a common heap
// (event_heap.hpp).
// What is scheduled for the very instant that is being processed, as every dispatch is, needs no
// place: of each class it stands in a line, which is next unless the ranking has something of that
// instant. The next event is the least of these: exact for any schedule, and fast for the usual
// one, whose cost does not grow with the number of events that are pending.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "model/engine/chunk_queue.hpp"
#include "model/engine/event_heap.hpp"
#include "model/event.hpp"
#include "model/units.hpp"

namespace stormproof::model {

class EventQueue {
 public:
  /// Inserts an event with the next insertion number; returns that number.
  [[gnu::always_inline]] std::uint64_t schedule(Nanoseconds time, EventKind kind,
                                                std::uint32_t subject, std::uint32_t detail = 0) {
    return schedule_as(class_of(kind), time, kind, subject, detail);
  }

  /// The same in a class that need not be the one of its kind: a deliberate mistake.
  [[gnu::always_inline]] std::uint64_t schedule_as(EventClass event_class, Nanoseconds time,
                                                   EventKind kind, std::uint32_t subject,
                                                   std::uint32_t detail) {
    const std::uint64_t insertion = inserted_++;
    const std::uint64_t order = static_cast<std::uint64_t>(event_class) << 62 | insertion;
    ++size_;
    if (is_idle(kind)) ++idle_;
    if (time == instant_) {
      const auto line = static_cast<std::size_t>(event_class);
      lines_ |= 1U << line;
      fill(at_once_[line].push_back(), order, subject, detail, kind);
    } else {
      insert(time, order, kind, subject, detail);
    }
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

  /// Removes and returns the next event. The queue must not be empty.
  Event pop() {
    --size_;
    if (!heap_.empty() && is_heap_next()) return pop_heap();
    if (lines_ == 0) {
      instant_ = ranking_[ranked_ - 1].time;
    } else if (ranked_ == 0 || !is_before_lines(ranking_[ranked_ - 1])) {
      return pop_at_once();
    }
    const Ranked& first = ranking_[--ranked_];
    const std::size_t number = first.lane;
    const auto kind = static_cast<EventKind>(number);
    if (is_idle(kind)) --idle_;
    const Event event{first.time, first.order, first.subject, first.detail, kind};
    Lane& lane = lanes_[number];
    if (lane.others.empty()) {
      lane.is_ranked = false;
    } else {
      const Waiting& next = lane.others.front();
      fill(enter(next.time, next.order), next.time, next.order, next.subject, next.detail, number);
      lane.others.pop_front();
    }
    return event;
  }

 private:
  /// Whose order breaks once breaks it again as a rule, as that of random delays does.
  static constexpr unsigned others_to_heap = 32;

  /// An event of a lane.
  struct Waiting {
    Nanoseconds time;
    std::uint64_t order = 0;
    std::uint32_t subject = 0;
    std::uint32_t detail = 0;
  };
  /// The first one of a lane.
  struct Ranked : Waiting {
    std::size_t lane = 0;
  };
  /// An event of the instant.
  struct AtOnce {
    std::uint64_t order = 0;
    std::uint32_t subject = 0;
    std::uint32_t detail = 0;
    EventKind kind{};
  };
  struct Lane {
    bool is_ranked = false;
    unsigned to_heap = 0;   // so many of its next events go there, without a look at their order
    Nanoseconds last_time;  // of its last event, if it is ranked
    std::uint64_t last_order = 0;
    ChunkQueue<Waiting> others;  // behind the first one
  };

  // Events are written and copied member by member: see ChunkQueue::push_back.
  static void fill(Waiting& one, Nanoseconds time, std::uint64_t order, std::uint32_t subject,
                   std::uint32_t detail) {
    one.time = time;
    one.order = order;
    one.subject = subject;
    one.detail = detail;
  }
  static void fill(Ranked& one, Nanoseconds time, std::uint64_t order, std::uint32_t subject,
                   std::uint32_t detail, std::size_t lane) {
    fill(one, time, order, subject, detail);
    one.lane = lane;
  }
  static void fill(AtOnce& one, std::uint64_t order, std::uint32_t subject, std::uint32_t detail,
                   EventKind kind) {
    one.order = order;
    one.subject = subject;
    one.detail = detail;
    one.kind = kind;
  }

  static constexpr bool is_idle(EventKind kind) {
    return kind == EventKind::announcement_due || kind == EventKind::lease_check;
  }

  /// The line of the least class, of those that are not empty.
  [[nodiscard]] std::size_t next_line() const {
    return static_cast<std::size_t>(std::countr_zero(lines_));
  }
  template <class First>
  [[nodiscard]] bool is_before_lines(const First& first) const {
    return is_before(first.time, first.order, instant_, at_once_[next_line()].front().order);
  }
  Event pop_at_once() {
    ChunkQueue<AtOnce>& line = at_once_[next_line()];
    const AtOnce& first = line.front();
    const Event event{instant_, first.order, first.subject, first.detail, first.kind};
    if (is_idle(event.kind)) --idle_;
    line.pop_front();
    if (line.empty()) lines_ &= lines_ - 1;
    return event;
  }

  /// Inserts what is not of this instant.
  [[gnu::noinline]] void insert(Nanoseconds time, std::uint64_t order, EventKind kind,
                                std::uint32_t subject, std::uint32_t detail) {
    const auto number = static_cast<std::size_t>(kind);
    Lane& lane = lanes_[number];
    if (lane.to_heap > 0) {
      --lane.to_heap;
      return heap_.push(EventHeap::Entry::of({time, order, subject, detail, kind}));
    }
    if (lane.is_ranked && !is_before(lane.last_time, lane.last_order, time, order)) [[unlikely]] {
      lane.to_heap = others_to_heap;
      return heap_.push(EventHeap::Entry::of({time, order, subject, detail, kind}));
    }
    lane.last_time = time;
    lane.last_order = order;
    if (!lane.is_ranked) {
      lane.is_ranked = true;
      fill(enter(time, order), time, order, subject, detail, number);
    } else {
      fill(lane.others.push_back(), time, order, subject, detail);
    }
  }

  /// Makes a place in the ranking. Few others precede it as a rule.
  Ranked& enter(Nanoseconds time, std::uint64_t order) {
    std::size_t k = ranked_++;
    for (; k > 0; --k) {
      const Ranked& other = ranking_[k - 1];
      if (is_before(time, order, other.time, other.order)) break;
      fill(ranking_[k], other.time, other.order, other.subject, other.detail, other.lane);
    }
    return ranking_[k];
  }

  [[nodiscard]] bool is_heap_next() {
    const Event first = heap_.first().event();
    if (ranked_ > 0) {
      const Ranked& ranked = ranking_[ranked_ - 1];
      if (is_before(ranked.time, ranked.order, first.time, first.order)) return false;
    }
    return lines_ == 0 || is_before_lines(first);
  }
  Event pop_heap() {
    const Event event = heap_.first().event();
    heap_.pop_first();
    if (lines_ == 0) instant_ = event.time;
    if (is_idle(event.kind)) --idle_;
    return event;
  }

  std::array<Lane, event_kind_count> lanes_;
  EventHeap heap_;
  std::array<Ranked, event_kind_count> ranking_;  // the next one is last
  std::size_t ranked_ = 0;
  std::size_t size_ = 0;
  std::size_t idle_ = 0;  // of these, announcements and looks at whether there were any
  std::uint64_t inserted_ = 0;
  Nanoseconds instant_;                        // that is being processed
  unsigned lines_ = 0;                         // which of these are not empty, a bit each
  std::array<ChunkQueue<AtOnce>, 3> at_once_;  // of the instant, by class
};

}  // namespace stormproof::model
