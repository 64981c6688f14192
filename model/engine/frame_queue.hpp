// The frames that one transmitter holds for one destination, with `service: unit`: in one line, or
// one for each flow (Linux mac80211's fair queueing, specs/guide/wifi.md, "Flows"). A frame that
// did not fit into a unit goes back and is next, before all others. With CoDel, frames of a line
// that wait for too long are dropped when it is their turn.
#pragma once

#include <compare>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "model/engine/codel.hpp"

namespace stormproof::model {

/// What the kernel takes for one conversation: addresses and ports, but of a datagram in several
/// fragments the addresses alone.
struct Flow {
  static constexpr std::uint32_t everybody = UINT32_MAX;

  bool by_host = false;  ///< then source and destination are hosts, else participants
  std::uint32_t source = 0;
  std::uint32_t destination = 0;  ///< or `everybody`
  std::uint32_t port = 0;         ///< 1: data of applications, 0: all else

  auto operator<=>(const Flow&) const = default;
};

class FrameQueue {
 public:
  struct Line {
    FrameLine frames;
    CoDel codel;
    std::int64_t deficit = 0;
    bool listed = false;
  };

  /// A quantum of 0 keeps no flows apart.
  explicit FrameQueue(std::int64_t quantum) : quantum_{quantum} {}

  [[nodiscard]] bool empty() const { return size_ == 0 && !returned_; }
  /// Of a queue without flows that is not empty.
  [[nodiscard]] const Frame& head() const { return returned_ ? *returned_ : line_.frames.front(); }

  void push(const Frame& frame, const Flow& flow) {
    ++size_;
    if (quantum_ == 0) return line_.frames.push(frame);
    Line& line = flows_[flow];
    line.frames.push(frame);
    if (line.listed) return;
    line.listed = true;
    line.deficit = quantum_;
    new_.push_back(&line);
  }
  /// Takes the next frame, if there is one and none has gone back. With limits, `late` gets those
  /// before it that waited for too long.
  std::optional<Frame> next(const std::optional<CoDel::Limits>& limits, Nanoseconds now,
                            std::vector<Frame>& late) {
    Line* const line = quantum_ == 0 ? &line_ : next_flow();
    if (line == nullptr || line->frames.empty()) return std::nullopt;
    const Frame frame = limits ? line->codel.next(*limits, now, line->frames,
                                                  [&](const Frame& one) { late.push_back(one); })
                               : line->frames.pop();
    size_ -= 1 + late.size();
    line->deficit -= frame.bytes;
    return frame;
  }
  /// The frame that was taken last goes back.
  void put_back(const Frame& frame) { returned_ = frame; }
  [[nodiscard]] bool has_returned() const { return returned_.has_value(); }
  Frame take_returned() { return *std::exchange(returned_, std::nullopt); }

  /// The line with the most bytes, of equals the one with the oldest head; null if all are empty.
  [[nodiscard]] Line* longest() {
    Line* longest = line_.frames.empty() ? nullptr : &line_;
    for (const std::list<Line*>* list : {&new_, &old_}) {
      for (Line* const line : *list) longest = longer(longest, line);
    }
    return longest;
  }
  [[nodiscard]] static Line* longer(Line* one, Line* other) {
    if (other == nullptr || other->frames.empty()) return one;
    if (one == nullptr || other->frames.bytes() > one->frames.bytes()) return other;
    if (other->frames.bytes() < one->frames.bytes()) return one;
    return other->frames.front().number < one->frames.front().number ? other : one;
  }
  /// Takes the first frame of a line of its own.
  Frame take_head(Line& line) {
    --size_;
    return line.frames.pop();
  }

 private:
  /// The flow whose turn it is; it has a frame.
  Line* next_flow() {
    while (!new_.empty() || !old_.empty()) {
      std::list<Line*>& list = new_.empty() ? old_ : new_;
      Line& line = *list.front();
      if (line.deficit <= 0) {
        line.deficit += quantum_;
        old_.splice(old_.end(), list, list.begin());
      } else if (line.frames.empty()) {
        leave(list);
      } else {
        return &line;
      }
    }
    return nullptr;
  }
  /// A new flow that has nothing more waits behind the old ones, so that it gains nothing by it.
  void leave(std::list<Line*>& list) {
    if (&list == &new_ && !old_.empty()) {
      old_.splice(old_.end(), list, list.begin());
      return;
    }
    list.front()->listed = false;
    list.pop_front();
  }

  std::int64_t quantum_;
  std::size_t size_ = 0;  // in lines
  std::optional<Frame> returned_;
  Line line_;                   // without flows
  std::map<Flow, Line> flows_;  // a flow stays at its place
  std::list<Line*> new_;
  std::list<Line*> old_;
};

}  // namespace stormproof::model
