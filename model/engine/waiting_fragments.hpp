// The fragments that wait for one channel. Time never goes back, so the requests of one stage
// arrive in ascending (request time, request number): each stage is a plain queue, and the
// channel's choice, the least (request time, stage rank, request number), is the least of a few
// heads. What is requested at once, one after the other, stands in such a queue as one request.
#pragma once

#include <cstdint>
#include <vector>

#include "model/engine/chunk_queue.hpp"
#include "model/units.hpp"

namespace stormproof::model {

struct ServiceRequest {
  Nanoseconds time;
  std::uint64_t number = 0;  ///< one counter for all requests of a run
  std::uint32_t slot = 0;    ///< the packet
  std::uint32_t fragment = 0;
  std::uint32_t from = 0;     ///< the access point that sends it, on the way down; or the source
  std::uint32_t packets = 1;  ///< it stands for this fragment of as many packets of the source
};

class WaitingFragments {
 public:
  /// Adds a stage with this rank; returns its position in this channel.
  std::uint32_t add_stage(int rank) {
    stages_.push_back({rank, {}});
    return static_cast<std::uint32_t>(stages_.size() - 1);
  }

  void push(std::uint32_t position, const ServiceRequest& request) {
    ServiceRequest& last = stages_[position].requests.push_back();
    last.time = request.time;
    last.number = request.number;
    last.slot = request.slot;
    last.fragment = request.fragment;
    last.from = request.from;
    last.packets = request.packets;
    size_ += request.packets;
  }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Removes the fragment that is served next into `chosen`; returns the position of its stage.
  /// Something must wait.
  std::uint32_t pop(ServiceRequest& chosen) {
    std::size_t best = stages_.size();
    for (std::size_t k = 0; k < stages_.size(); ++k) {
      if (stages_[k].requests.empty()) continue;
      if (best == stages_.size() || stages_[k].before(stages_[best])) best = k;
    }
    ServiceRequest& first = stages_[best].requests.front();
    chosen.time = first.time;
    chosen.number = first.number;
    chosen.slot = first.slot;
    chosen.fragment = first.fragment;
    chosen.from = first.from;
    --size_;
    ++first.number;
    if (--first.packets == 0) stages_[best].requests.pop_front();
    return static_cast<std::uint32_t>(best);
  }

 private:
  struct StageQueue {
    int rank;
    ChunkQueue<ServiceRequest> requests;

    [[nodiscard]] bool before(const StageQueue& other) const {
      const ServiceRequest& a = requests.front();
      const ServiceRequest& b = other.requests.front();
      if (a.time != b.time) return a.time < b.time;
      if (rank != other.rank) return rank < other.rank;
      return a.number < b.number;
    }
  };

  std::vector<StageQueue> stages_;
  std::size_t size_ = 0;
};

}  // namespace stormproof::model
