// When frames that wait for too long are dropped: CoDel as RFC 8289 has it (section 5), to the
// nanosecond (specs/guide/wifi.md, "Queues that drop"). It looks at frames as they leave a line:
// once each has waited for `target` or longer, for an `interval` on end, one is dropped, the next
// one interval/√2 later, then interval/√3, until one has waited for less.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "model/wireless_profile.hpp"

namespace stormproof::model {

/// One fragment that waits for the channel.
struct Frame {
  std::uint64_t number = 0;  ///< of its request; one counter for all requests of a run
  std::uint32_t slot = 0;    ///< the packet
  std::uint32_t fragment = 0;
  std::int64_t bytes = 0;  ///< on the channel, without delimiter and padding
  Nanoseconds since = {};  ///< when it asked
};

/// Frames in order, and how many bytes they are.
class FrameLine {
 public:
  [[nodiscard]] bool empty() const { return frames_.empty(); }
  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }
  [[nodiscard]] const Frame& front() const { return frames_.front(); }
  void push(const Frame& frame) {
    frames_.push_back(frame);
    bytes_ += frame.bytes;
  }
  Frame pop() {
    const Frame frame = frames_.front();
    frames_.pop_front();
    bytes_ -= frame.bytes;
    return frame;
  }

 private:
  std::deque<Frame> frames_;
  std::int64_t bytes_ = 0;
};

/// interval/√count, rounded down.
[[nodiscard]] inline std::int64_t codel_spacing_ns(std::int64_t interval_ns, std::uint32_t count) {
  __extension__ using Wide = unsigned __int128;
  const Wide square = Wide{static_cast<std::uint64_t>(interval_ns)} *
                      static_cast<std::uint64_t>(interval_ns) / count;
  Wide root = static_cast<std::uint64_t>(interval_ns);  // from above, by Newton's steps
  while (root * root > square) root = (root + square / root) / 2;
  return static_cast<std::int64_t>(root);
}

class CoDel {
 public:
  struct Limits {
    std::int64_t target_ns = 0;
    std::int64_t interval_ns = 0;
    std::int64_t longest_frame = 0;  ///< bytes; what is left may be so much
  };

  /// Takes the next frame of a line that is not empty; `drop(frame)`: those before it. The last
  /// one of a line is never dropped.
  template <class Drop>
  Frame next(const Limits& limits, Nanoseconds now, FrameLine& line, Drop&& drop) {
    Taken taken = take(limits, now.count(), line);
    if (drops_) {
      drops_ = taken.may_be_dropped;
      while (drops_ && now.count() >= next_drop_) {
        drop(taken.frame);
        ++count_;
        taken = take(limits, now.count(), line);
        drops_ = taken.may_be_dropped;
        if (drops_) next_drop_ += codel_spacing_ns(limits.interval_ns, count_);
      }
    } else if (taken.may_be_dropped) {
      drop(taken.frame);
      taken = take(limits, now.count(), line);
      begin(limits, now.count());
    }
    return taken.frame;
  }

 private:
  struct Taken {
    Frame frame;
    bool may_be_dropped = false;
  };

  Taken take(const Limits& limits, std::int64_t now, FrameLine& line) {
    Taken taken{line.pop()};
    const std::int64_t waited = now - taken.frame.since.count();
    if (waited < limits.target_ns || line.bytes() <= limits.longest_frame) {
      drops_from_.reset();
    } else if (!drops_from_) {
      drops_from_ = now + limits.interval_ns;
    } else {
      taken.may_be_dropped = now >= *drops_from_;
    }
    return taken;
  }
  /// Soon after the last time it goes on where it was.
  void begin(const Limits& limits, std::int64_t now) {
    drops_ = true;
    const std::uint32_t more = count_ - count_at_begin_;
    const bool again = more > 1 && now - next_drop_ < 16 * limits.interval_ns;
    count_ = count_at_begin_ = again ? more : 1;
    next_drop_ = now + codel_spacing_ns(limits.interval_ns, count_);
  }

  bool drops_ = false;
  std::optional<std::int64_t> drops_from_;  // if frames wait for that long until then
  std::int64_t next_drop_ = 0;
  std::uint32_t count_ = 0;  // of drops in a row
  std::uint32_t count_at_begin_ = 0;
};

}  // namespace stormproof::model
