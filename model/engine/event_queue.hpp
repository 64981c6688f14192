// The one event queue: the next event is the least (time, class, insertion number). The classes
// make the order of same-time events what the model asks for: a reception comes before any protocol
// decision of that instant, and a channel starts serving after both (specs/guide/model.md, "Events
// and their order").
//
// Nearly every kind of event is scheduled at a constant distance from now, so its events arrive in
// ascending order. Each kind therefore has a lane: its first event stands in a short ranking, the
// others in a plain queue behind it; what would break the order of its lane goes to a common heap.
// The next event is the least of the ranking: exact for any schedule, and fast for the usual one,
// whose cost does not grow with the number of events that are pending.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "model/engine/chunk_queue.hpp"
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
    const auto number = static_cast<std::size_t>(kind);
    Lane& lane = lanes_[number];
    if (lane.is_ranked && !is_before(lane.last_time, lane.last_order, time, order)) [[unlikely]] {
      push_heap({time, order, subject, detail, kind});
    } else {
      lane.last_time = time;
      lane.last_order = order;
      if (!lane.is_ranked) {
        lane.is_ranked = true;
        fill(enter(time, order), time, order, subject, detail, number);
      } else {
        fill(lane.others.push_back(), time, order, subject, detail);
      }
    }
    ++size_;
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
  [[nodiscard]] bool is_quiet() const {
    const auto in_lane = [&](EventKind kind) {
      const Lane& lane = lanes_[static_cast<std::size_t>(kind)];
      return lane.others.size() + (lane.is_ranked ? 1U : 0U);
    };
    const std::size_t others =
        size_ - in_lane(EventKind::announcement_due) - in_lane(EventKind::lease_check);
    return others == heap_.size() &&
           std::ranges::all_of(heap_, [](const Event& event) { return is_idle(event.kind); });
  }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Time of the next event. The queue must not be empty.
  [[nodiscard]] Nanoseconds next_time() const { return ranking_[ranked_ - 1].time; }

  /// Removes and returns the next event. The queue must not be empty.
  Event pop() {
    --size_;
    const Ranked& first = ranking_[--ranked_];
    const std::size_t number = first.lane;
    if (number == heap_lane) [[unlikely]]
      return pop_heap();
    const Event event{first.time, first.order, first.subject, first.detail,
                      static_cast<EventKind>(number)};
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
  static constexpr std::size_t heap_lane = event_kind_count;

  /// An event of a lane.
  struct Waiting {
    Nanoseconds time;
    std::uint64_t order = 0;
    std::uint32_t subject = 0;
    std::uint32_t detail = 0;
  };
  /// The first one of a lane, or of the heap.
  struct Ranked : Waiting {
    std::size_t lane = 0;
  };
  struct Lane {
    bool is_ranked = false;
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

  static constexpr bool is_idle(EventKind kind) {
    return kind == EventKind::announcement_due || kind == EventKind::lease_check;
  }
  static bool later(const Event& a, const Event& b) { return b.before(a); }

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

  /// The least event of the heap stands in the ranking as well.
  void rank_heap() {
    const Event& first = heap_.front();
    fill(enter(first.time, first.order), first.time, first.order, first.subject, first.detail,
         heap_lane);
  }
  void push_heap(const Event& event) {
    const bool first = heap_.empty() || event.before(heap_.front());
    heap_.push_back(event);
    std::push_heap(heap_.begin(), heap_.end(), later);
    if (!first) return;
    const auto end = ranking_.begin() + static_cast<std::ptrdiff_t>(ranked_);
    const auto other =
        std::find_if(ranking_.begin(), end, [](const Ranked& r) { return r.lane == heap_lane; });
    if (other != end) {
      std::copy(other + 1, end, other);
      --ranked_;
    }
    rank_heap();
  }

  Event pop_heap() {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Event event = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) rank_heap();
    return event;
  }

  std::array<Lane, event_kind_count> lanes_;
  std::vector<Event> heap_;
  std::array<Ranked, event_kind_count + 1> ranking_;  // the next one is last
  std::size_t ranked_ = 0;
  std::size_t size_ = 0;
  std::uint64_t inserted_ = 0;
};

}  // namespace stormproof::model
