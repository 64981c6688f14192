// The sending side of one participant: an unbounded backlog of generated packets in front of a
// source queue of W bytes. A packet is admitted when its fragments' bytes fit, or when the queue is
// empty (so a packet larger than W is admitted alone); it frees its bytes when its last source-side
// fragment has been served. Admission only counts: a packet stays written down, beside thousands of
// others, until the channel takes it.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "model/airtime.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/packet_tape.hpp"
#include "model/run_result.hpp"

namespace stormproof::model {

class SourceQueue {
 public:
  void push(Packet&& packet, const Fragmentation& fragmentation) {
    packets_ += packet.copies;
    tape_.write(std::move(packet));
    if (packets_of_head_ == 0) measure_head(fragmentation);
  }

  /// How many packets of the first record of the backlog fit.
  [[nodiscard]] std::uint32_t fitting(Bytes capacity) const {
    if (packets_of_head_ == 0) return 0;
    const std::int64_t room = capacity.count() - admitted_bytes_;
    if (room < head_demand_) return admitted_bytes_ == 0 ? 1 : 0;
    if (packets_of_head_ == 1) return 1;
    return static_cast<std::uint32_t>(
        std::min(std::int64_t{packets_of_head_}, room / head_demand_));
  }

  [[nodiscard]] std::int64_t head_fragments() const { return head_fragments_; }
  [[nodiscard]] std::int64_t head_demand() const { return head_demand_; }

  /// Admits as many packets of the first record.
  void admit_head(const Fragmentation& fragmentation, std::uint32_t packets = 1) {
    admitted_bytes_ += head_demand_ * packets;
    packets_ -= packets;
    packets_of_head_ -= packets;
    if (packets_of_head_ == 0 && packets_ > 0) measure_head(fragmentation);
  }

  /// The first packet that is admitted and has not been taken. `next(packet, pair)`: the recipient
  /// of a record of several packets after this one.
  template <class Next>
  void take(Packet& packet, Next&& next) {
    if (taken_.copies == 0) {
      service_.take(tape_, packet);
      if (packet.copies == 1) return;
      taken_ = std::move(packet);
    }
    if (taken_.copies > 1) return take_copy(taken_, packet, next);
    packet = std::move(taken_);
    taken_.copies = 0;
  }
  /// The first of several packets that are one record, which then stands for the others.
  template <class Next>
  static void take_copy(Packet& record, Packet& copy, Next&& next) {
    copy.become(record);
    copy.copies = 1;
    ++record.number;
    --record.copies;
    record.pair = next(record, record.pair);
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
  static Packet none() {
    Packet packet;
    packet.copies = 0;
    return packet;
  }
  void measure_head(const Fragmentation& fragmentation) {
    const PacketTape::Reader::Size head = admission_.skim(tape_);
    packets_of_head_ = head.copies;
    head_fragments_ = fragmentation.count(head.payload_bytes);
    head_demand_ = fragmentation.demand(head.payload_bytes, head_fragments_);
  }

  PacketTape tape_;  // of what nobody has taken
  PacketTape::Reader admission_;
  PacketTape::Reader service_;
  Packet taken_ = none();              // a record of which some are taken, and not all
  std::uint64_t packets_ = 0;          // in the backlog, copies counted
  std::uint32_t packets_of_head_ = 0;  // of its first record
  std::int64_t admitted_bytes_ = 0;
  std::int64_t head_fragments_ = 0;
  std::int64_t head_demand_ = 0;
  BacklogPeak peak_;
};

}  // namespace stormproof::model
