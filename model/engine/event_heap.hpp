// Events that come in no order, as those with random delays do: the least comes out first. Beside
// the lanes of the event queue (event_queue.hpp), which hold what comes in ascending order.
//
// Few events make a binary heap. Its comparison is one of numbers, without a branch that nobody can
// predict; and the place of an event that was taken stays open until it is known what comes next,
// which is an event that is put in as often as not, and then one way through the heap does for
// both.
//
// More than that would make the heap leave the cache. They lie in ladders of buckets by their time,
// coarse ones below fine ones, and only those of the first bucket in the heap (Tang, Goh and Thng,
// "Ladder queue", 2005, with a heap as its bottom). A bucket that is itself too long becomes a
// ladder of finer ones. So the cost of an event does not grow with the number of those that are
// pending, whatever the distribution of their times.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "model/event.hpp"
#include "model/units.hpp"

namespace stormproof::model {

class EventHeap {
 public:
  /// An event in whole words: what is written in parts and at once moved as a whole makes the
  /// processor wait (see ChunkQueue::push_back).
  struct Entry {
    std::int64_t time = 0;      ///< ns, not negative
    std::uint64_t order = 0;    ///< as that of an event
    std::uint64_t content = 0;  ///< subject above detail
    std::uint64_t kind = 0;

    [[nodiscard]] static Entry of(const Event& event) {
      return {event.time.count(), event.order,
              static_cast<std::uint64_t>(event.subject) << 32 | event.detail,
              static_cast<std::uint64_t>(event.kind)};
    }
    [[nodiscard]] Event event() const {
      return {Nanoseconds{time}, order, static_cast<std::uint32_t>(content >> 32),
              static_cast<std::uint32_t>(content), static_cast<EventKind>(kind)};
    }
  };
  [[nodiscard]] bool empty() const { return size_ == 0; }

  /// Inserts an event.
  [[gnu::always_inline]] void push(const Entry& event) {
    ++size_;
    if (event.time < bound_) {
      near_.push(event);
      if (near_.size() > limit_) spread();
    } else {
      place(event);
    }
  }

  /// The next event. There must be one.
  [[nodiscard]] const Entry& first() {
    if (near_.size() == 0) refill();
    return near_.first();
  }

  /// Removes the one that first() has returned.
  void pop_first() {
    --size_;
    near_.pop_first();
  }

 private:
  __extension__ using Key = unsigned __int128;
  using Time = std::int64_t;

  /// The order of events, is_before, as one number.
  static Key key(const Entry& event) {
    return static_cast<Key>(static_cast<std::uint64_t>(event.time)) << 64 | event.order;
  }

  /// A binary heap whose root may be open.
  class Near {
   public:
    [[nodiscard]] std::size_t size() const { return events_.size() - (open_ ? 1 : 0); }
    [[nodiscard]] const Entry& first() {
      close();
      return events_.front();
    }
    void pop_first() { open_ = true; }
    [[gnu::always_inline]] void push(const Entry& event) {
      if (open_) {
        open_ = false;
        sink(event);
      } else {
        events_.emplace_back();
        rise(events_.size() - 1, event);
      }
    }
    /// Takes over what is in the bucket, and empties it.
    void fill(std::vector<Entry>& bucket) {
      for (const Entry& event : bucket) push(event);
      bucket.clear();
    }
    /// All events, in no order.
    std::vector<Entry>& all() {
      close();
      return events_;
    }

   private:
    void close() {
      if (!open_) return;
      open_ = false;
      const Entry last = events_.back();
      events_.pop_back();
      if (!events_.empty()) sink(last);
    }
    /// Fills the root: what is less goes up to the last level, and the event from there.
    [[gnu::always_inline]] void sink(const Entry& event) {
      Entry* const all = events_.data();
      const std::size_t size = events_.size();
      std::size_t hole = 0;
      std::size_t child = 1;
      for (; child + 1 < size; child = 2 * hole + 1) {
        child += static_cast<std::size_t>(key(all[child + 1]) < key(all[child]));
        all[hole] = all[child];
        hole = child;
      }
      if (child < size) {
        all[hole] = all[child];
        hole = child;
      }
      rise(hole, event);
    }
    [[gnu::always_inline]] void rise(std::size_t hole, const Entry& event) {
      Entry* const all = events_.data();
      const Key own = key(event);
      while (hole > 0) {
        const std::size_t parent = (hole - 1) / 2;
        if (key(all[parent]) < own) break;
        all[hole] = all[parent];
        hole = parent;
      }
      all[hole] = event;
    }

    std::vector<Entry> events_;
    bool open_ = false;  // the root has been taken
  };

  /// Buckets of 2^shift ns from `begin` on; those before `next` are empty.
  struct Ladder {
    Time begin = 0;
    Time end = 0;
    int shift = 0;
    std::size_t next = 0;
    std::size_t used = 0;
    std::vector<std::vector<Entry>> buckets;

    void put(const Entry& event) {
      buckets[static_cast<std::size_t>((event.time - begin) >> shift)].push_back(event);
    }
  };

  static constexpr std::size_t most = 1024;   // in the heap, before it is spread
  static constexpr std::size_t planned = 64;  // in a bucket
  static constexpr Time never = std::numeric_limits<Time>::max();

  /// Puts what is not near into the finest ladder that reaches so far.
  void place(const Entry& event) {
    for (std::size_t k = depth_; k-- > 0;) {
      if (event.time < ladders_[k].end) return ladders_[k].put(event);
    }
    beyond_.push_back(event);
  }

  /// Makes a finer ladder of the heap.
  [[gnu::noinline]] void spread() {
    std::vector<Entry>& events = near_.all();
    if (climb(events)) {
      bound_ = ladders_[depth_ - 1].begin;
      limit_ = most;
    } else {
      limit_ = 2 * events.size();  // all at one time
    }
  }

  /// A ladder of these events, above the others; false if all have the same time. Empties them.
  bool climb(std::vector<Entry>& events) {
    const auto sooner = [](const Entry& a, const Entry& b) { return a.time < b.time; };
    const auto [first, last] = std::minmax_element(events.begin(), events.end(), sooner);
    if (first->time == last->time) return false;
    const Time begin = first->time;
    const Time latest = (bound_ == never ? last->time : bound_ - 1) - begin;
    if (ladders_.size() == depth_) ladders_.emplace_back();
    Ladder& ladder = ladders_[depth_++];
    ladder.begin = begin;
    ladder.shift = 0;
    ladder.next = 0;
    while (static_cast<std::size_t>(latest >> ladder.shift) > events.size() / planned) {
      ++ladder.shift;
    }
    ladder.used = static_cast<std::size_t>(latest >> ladder.shift) + 1;
    // That of a bucket ends where the bucket does.
    const Time reach = static_cast<Time>(ladder.used) << ladder.shift;
    ladder.end = bound_ == never ? begin + reach : bound_;
    if (ladder.buckets.size() < ladder.used) ladder.buckets.resize(ladder.used);
    for (const Entry& event : events) ladder.put(event);
    events.clear();
    return true;
  }

  /// Fills the heap, which is empty, from the next bucket.
  [[gnu::noinline]] void refill() {
    std::vector<Entry>& events = next_bucket();
    limit_ = std::max(most, events.size());
    if (events.size() <= most || !climb(events)) {
      near_.fill(events);
    } else {
      bound_ = ladders_[depth_ - 1].begin;
      refill();
    }
  }

  /// The next events that are not near, which all others follow.
  std::vector<Entry>& next_bucket() {
    while (depth_ > 0) {
      Ladder& ladder = ladders_[depth_ - 1];
      while (ladder.next < ladder.used && ladder.buckets[ladder.next].empty()) ++ladder.next;
      if (ladder.next < ladder.used) {
        std::vector<Entry>& bucket = ladder.buckets[ladder.next++];
        const Time end = ladder.begin + (static_cast<Time>(ladder.next) << ladder.shift);
        bound_ = std::min(ladder.end, end);
        return bucket;
      }
      bound_ = ladder.end;
      --depth_;
    }
    bound_ = never;
    return beyond_;
  }

  Near near_;                    // all before the bound
  Time bound_ = never;           // ns
  std::size_t limit_ = most;     // of events in the heap
  std::vector<Ladder> ladders_;  // from the coarsest to the finest
  std::size_t depth_ = 0;        // how many of these there are
  std::vector<Entry> beyond_;    // after the coarsest
  std::size_t size_ = 0;
};

}  // namespace stormproof::model
