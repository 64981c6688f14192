// The sending side of one participant: an unbounded backlog of generated packets in front of a
// source queue of W bytes. A packet is admitted when its fragments' bytes fit, or when the queue is
// empty (so a packet larger than W is admitted alone); it frees its bytes when its last source-side
// fragment has been served.
#pragma once

#include <cassert>
#include <cstdint>
#include <deque>

#include "model/airtime.hpp"
#include "model/engine/packet.hpp"
#include "model/run_result.hpp"

namespace stormproof::model {

class SourceQueue {
 public:
  void push(Packet&& packet, const Fragmentation& fragmentation) {
    packets_ += packet.copies;
    backlog_.push_back(std::move(packet));
    if (backlog_.size() == 1) measure_head(fragmentation);
  }

  [[nodiscard]] bool head_fits(Bytes capacity) const {
    return !backlog_.empty() &&
           (admitted_bytes_ == 0 || head_demand_ <= capacity.count() - admitted_bytes_);
  }

  [[nodiscard]] Packet& head() { return backlog_.front(); }
  [[nodiscard]] std::int64_t head_fragments() const { return head_fragments_; }
  [[nodiscard]] std::int64_t head_demand() const { return head_demand_; }

  /// Accounts for one admitted copy of the head; the caller has copied or moved it.
  void admit_head(bool last_copy, const Fragmentation& fragmentation) {
    admitted_bytes_ += head_demand_;
    --packets_;
    if (!last_copy) return;
    backlog_.pop_front();
    if (!backlog_.empty()) measure_head(fragmentation);
  }

  /// To be called when nothing more fits: what is left is the backlog.
  void note_peak(Nanoseconds now) {
    if (packets_ > peak_.packets) {
      peak_.packets = packets_;
      peak_.at = now;
    }
  }

  void release(std::int64_t demand) {
    admitted_bytes_ -= demand;
    assert(admitted_bytes_ >= 0);
  }

  [[nodiscard]] std::uint64_t backlog_packets() const { return packets_; }
  [[nodiscard]] std::int64_t admitted_bytes() const { return admitted_bytes_; }
  [[nodiscard]] BacklogPeak peak() const {
    BacklogPeak peak = peak_;
    peak.packets_at_end = packets_;
    return peak;
  }

 private:
  void measure_head(const Fragmentation& fragmentation) {
    const std::int64_t payload = backlog_.front().payload_bytes;
    head_fragments_ = fragmentation.count(payload);
    head_demand_ = fragmentation.demand(payload, head_fragments_);
  }

  std::deque<Packet> backlog_;
  std::uint64_t packets_ = 0;  // copies counted
  std::int64_t admitted_bytes_ = 0;
  std::int64_t head_fragments_ = 0;
  std::int64_t head_demand_ = 0;
  BacklogPeak peak_;
};

}  // namespace stormproof::model
