// The fragments that wait for one channel. Time never goes back, so the requests of one stage
// arrive in ascending (request time, request number): each stage is a plain queue, and the
// channel's choice, the least (request time, stage rank, request number), is the least of a few
// heads.
#pragma once

#include <cstdint>
#include <vector>

#include "model/engine/ring_buffer.hpp"
#include "model/units.hpp"

namespace stormproof::model {

struct ServiceRequest {
  Nanoseconds time;
  std::uint64_t number = 0;  ///< one counter for all requests of a run
  std::uint32_t slot = 0;    ///< the packet
  std::uint32_t fragment = 0;
  std::uint32_t access_point = 0;  ///< that sends it, on the way down
};

class WaitingFragments {
 public:
  /// Adds a stage with this rank; returns its position in this channel.
  std::uint32_t add_stage(int rank) {
    stages_.push_back({rank, {}});
    return static_cast<std::uint32_t>(stages_.size() - 1);
  }

  void push(std::uint32_t position, const ServiceRequest& request) {
    stages_[position].requests.push_back(request);
    ++size_;
  }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }

  struct Choice {
    ServiceRequest request;
    std::uint32_t position;
  };
  /// Removes and returns the fragment that is served next. Something must wait.
  Choice pop() {
    std::size_t best = stages_.size();
    for (std::size_t k = 0; k < stages_.size(); ++k) {
      if (stages_[k].requests.empty()) continue;
      if (best == stages_.size() || stages_[k].before(stages_[best])) best = k;
    }
    const Choice choice{stages_[best].requests.front(), static_cast<std::uint32_t>(best)};
    stages_[best].requests.pop_front();
    --size_;
    return choice;
  }

 private:
  struct StageQueue {
    int rank;
    RingBuffer<ServiceRequest> requests;

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
