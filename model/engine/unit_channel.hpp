// The channel of `service: unit` (specs/guide/wifi.md): hosts and their access points take turns,
// and whoever's turn it is sends a unit of frames to one destination (A-MPDU). What waits where,
// whose turn it is, what goes into the unit and how long it takes is here; when, and what follows,
// is the network's (model/engine/network.hpp).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "model/airtime.hpp"
#include "model/engine/frame_queue.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::model {

/// What one access to the channel carries.
struct Unit {
  bool downlink = false;
  bool multicast = false;          ///< down
  std::uint32_t access_point = 0;  ///< that sends it, down
  std::uint32_t host = 0;          ///< the station that sends it, up, or that it is for, down
  ServiceRate rate;                ///< of its frames
  std::vector<Frame> frames;
  std::vector<bool> lost = {};  ///< by frame, if transmissions may fail
  std::int64_t duration_ns = 0;
};

/// A frame that a queue has dropped.
struct DroppedFrame {
  Frame frame;
  std::optional<std::uint32_t> access_point = {};  ///< that dropped it; otherwise a station did
};

class UnitChannel {
 public:
  UnitChannel(const WirelessProfile& wireless, std::uint32_t hosts,
              std::uint32_t access_points = 1);

  /// Unicast to and from this host is sent at another rate than the profile's.
  void set_rate(std::uint32_t host, BitsPerSecond rate) {
    unicast_[host].bits_per_second = rate.count();
  }

  /// A host asks for an access to send this to the access point.
  void request_uplink(std::uint32_t host, const Frame& frame, const Flow& flow) {
    push(transmitters_[host], 0, frame, flow);
  }
  /// An access point asks for one to send it on, to a host or to all (`Flow::everybody`).
  void request_downlink(std::uint32_t host, const Frame& frame, const Flow& flow,
                        std::uint32_t access_point = 0) {
    push(transmitters_[hosts_ + access_point], host == Flow::everybody ? 0 : 1 + std::size_t{host},
         frame, flow);
  }

  [[nodiscard]] bool empty() const { return waiting_ == 0; }
  [[nodiscard]] std::size_t size() const { return waiting_; }

  /// Takes what is sent next. Something must wait.
  [[nodiscard]] Unit take(Nanoseconds now);
  /// The first of the frames that were dropped and that nobody has asked for.
  [[nodiscard]] std::optional<DroppedFrame> next_dropped();
  /// How long a unit with these frames takes: one as it is, several with delimiters and padding.
  [[nodiscard]] std::int64_t duration_ns(const std::vector<Frame>& frames,
                                         const ServiceRate& rate) const;
  /// How long a unit of several frames takes without its overhead, if their sizes with delimiter
  /// and padding make so many bytes.
  [[nodiscard]] static std::int64_t airtime_ns(std::int64_t bytes, const ServiceRate& rate) {
    return rate.airtime_ns(bytes) - rate.overhead_ns;
  }
  /// Bytes of a frame in a unit of several: 4 of its delimiter, padded to a multiple of 4.
  [[nodiscard]] static std::int64_t padded(std::int64_t bytes) { return 4 + (bytes + 3) / 4 * 4; }

 private:
  struct Queue {
    FrameQueue frames;
    std::uint64_t chosen = 0;  ///< when it was chosen last, 0: never
  };
  struct Transmitter {
    std::vector<Queue> queues;
    std::size_t waiting = 0;
    std::size_t limited_frames = 0;  // of these, without those that did not fit into a unit
    std::int64_t limited_bytes = 0;
    std::uint64_t chosen = 0;
    std::optional<std::uint32_t> access_point = {};  // that it is
    QueueDiscipline discipline = QueueDiscipline::unlimited;
    std::optional<CoDel::Limits> codel = {};
  };

  void manage_queues(const WirelessProfile& wireless);
  void push(Transmitter& transmitter, std::size_t queue, const Frame& frame, const Flow& flow);
  [[nodiscard]] bool is_over_limit(const Transmitter& transmitter) const;
  void shorten(Transmitter& transmitter);
  void joins(Transmitter& transmitter, const Frame& frame);
  void leaves(Transmitter& transmitter, const Frame& frame);
  void wait(Transmitter& transmitter, int frames);
  void drop(const Transmitter& transmitter, const Frame& frame) {
    dropped_.push_back({frame, transmitter.access_point});
  }
  [[nodiscard]] std::size_t choose_transmitter() const;
  [[nodiscard]] std::size_t choose_queue(const Transmitter& transmitter) const;
  void fill(Unit& unit, Transmitter& transmitter, FrameQueue& queue, Nanoseconds now);
  std::optional<Frame> next_frame(Transmitter& transmitter, FrameQueue& queue, Nanoseconds now);

  const Aggregation limits_;
  const QueueManagement management_;
  const bool in_turns_;         // of transmitters
  const bool queues_in_turns_;  // of the access point
  const std::size_t hosts_;
  std::vector<ServiceRate> unicast_;  // by host
  const ServiceRate multicast_;
  std::vector<Transmitter> transmitters_;  // the hosts, then the access points
  std::uint64_t choices_ = 0;
  std::size_t waiting_ = 0;
  std::deque<DroppedFrame> dropped_;
};

}  // namespace stormproof::model
