// Per-packet delay, from emission to reception, and lost packets, as an observer sees them: the Δ
// and k of every claim about bounded delay. A packet that is still under way counts with its age,
// so that "no packet took longer than Δ" is true of the whole run.
#pragma once

#include <algorithm>
#include <deque>

#include "model/probe.hpp"
#include "model/scenario.hpp"

namespace stormproof::props {

class DelayMeter {
 public:
  explicit DelayMeter(const model::Scenario& scenario);

  void emitted(const model::Packet& packet, model::Nanoseconds now);
  void arrived(const model::Packet& packet, bool lost);
  /// Same-host packets are left out: they never see the channel.
  void received(const model::Topology& topology, const model::Packet& packet,
                std::uint32_t receiver, model::Nanoseconds now);

  /// Δ of the run up to `end`: received packets and those under way.
  [[nodiscard]] model::Nanoseconds largest(model::Nanoseconds end) const;
  [[nodiscard]] model::Nanoseconds largest_received() const { return largest_; }
  /// Of packets that carry a descriptor for the first time.
  [[nodiscard]] model::Nanoseconds largest_initial_data() const { return largest_initial_; }
  /// Packets that will never be received, up to now.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

  /// Whether the other one measures the same of every run.
  [[nodiscard]] bool measures_as(const DelayMeter& other) const {
    return lost_packets_ == other.lost_packets_ && silent_loss_ == other.silent_loss_;
  }

 private:
  void leave(std::uint64_t number);
  [[nodiscard]] bool will_be_lost(std::uint64_t number) const {
    return std::binary_search(lost_packets_.begin(), lost_packets_.end(), number);
  }

  struct Copy {
    model::Nanoseconds emitted;
    bool left = false;
  };

  std::vector<std::uint64_t> lost_packets_;
  bool silent_loss_;            // no `arrived` tells of a lost packet
  std::deque<Copy> under_way_;  // in the order of their numbers
  std::uint64_t first_ = 0;     // number of the first of them
  model::Nanoseconds largest_;
  model::Nanoseconds largest_initial_;
  std::uint64_t lost_ = 0;
};

/// Every packet between two hosts takes the same time.
[[nodiscard]] bool takes_equal_times(const model::WirelessProfile& wireless);

/// How long packets within a host take; 0 where there are none.
[[nodiscard]] model::Nanoseconds loopback_of(const model::Scenario& scenario);

/// Whether the packet reaches `receiver` (as in `Probe::received`) over the network.
[[nodiscard]] bool crosses_hosts(const model::Topology& topology, const model::Packet& packet,
                                 std::uint32_t receiver);

}  // namespace stormproof::props
