// The frames that one transmitter holds for one destination, with `service: unit`: in one line, or
// one for each flow (Linux mac80211's fair queueing, specs/guide/wifi.md, "Flows"). A frame that
// did not fit into a unit goes back and is next, before all others.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <optional>

namespace stormproof::model {

/// One fragment that waits for the channel.
struct Frame {
  std::uint64_t number = 0;  ///< of its request; one counter for all requests of a run
  std::uint32_t slot = 0;    ///< the packet
  std::uint32_t fragment = 0;
  std::int64_t bytes = 0;  ///< on the channel, without delimiter and padding
};

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
  /// A quantum of 0 keeps no flows apart.
  explicit FrameQueue(std::int64_t quantum) : quantum_{quantum} {}

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Of a queue without flows that is not empty.
  [[nodiscard]] const Frame& head() const { return returned_ ? *returned_ : line_.front(); }

  void push(const Frame& frame, const Flow& flow) {
    ++size_;
    if (quantum_ == 0) return line_.push_back(frame);
    Line& line = flows_[flow];
    line.frames.push_back(frame);
    if (line.listed) return;
    line.listed = true;
    line.deficit = quantum_;
    new_.push_back(&line);
  }
  /// Takes the next frame, if there is one.
  std::optional<Frame> next() {
    if (returned_) {
      --size_;
      const Frame frame = *returned_;
      returned_.reset();
      return frame;
    }
    if (quantum_ > 0) return next_of_flows();
    if (line_.empty()) return std::nullopt;
    --size_;
    const Frame frame = line_.front();
    line_.pop_front();
    return frame;
  }
  /// The frame that was taken last.
  void put_back(const Frame& frame) {
    ++size_;
    returned_ = frame;
  }

 private:
  struct Line {
    std::deque<Frame> frames;
    std::int64_t deficit = 0;
    bool listed = false;
  };

  std::optional<Frame> next_of_flows() {
    while (!new_.empty() || !old_.empty()) {
      std::list<Line*>& list = new_.empty() ? old_ : new_;
      Line& line = *list.front();
      if (line.deficit <= 0) {
        line.deficit += quantum_;
        old_.splice(old_.end(), list, list.begin());
      } else if (line.frames.empty()) {
        leave(list);
      } else {
        --size_;
        const Frame frame = line.frames.front();
        line.frames.pop_front();
        line.deficit -= frame.bytes;
        return frame;
      }
    }
    return std::nullopt;
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
  std::size_t size_ = 0;
  std::optional<Frame> returned_;
  std::deque<Frame> line_;      // without flows
  std::map<Flow, Line> flows_;  // a flow stays at its place
  std::list<Line*> new_;
  std::list<Line*> old_;
};

}  // namespace stormproof::model
