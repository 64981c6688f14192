// The access point without sockets and clocks: requests go in with their times, services come out
// with theirs. It serves every Ethernet frame twice on one channel, uplink then downlink, by the
// simulator's rules (specs/guide/model.md, "Packets, fragments, queue, channel") and with the
// simulator's own parts: the states of fsm::Channel, the waiting fragments or the units of frames,
// the airtime. What it has beyond the simulator belongs to a real access point: queues that
// overflow, and frames that are lost.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "fsm/channel.hpp"
#include "fsm/flyweight.hpp"
#include "model/airtime.hpp"
#include "model/engine/slot_pool.hpp"
#include "model/engine/unit_channel.hpp"
#include "model/engine/waiting_fragments.hpp"

namespace stormproof::live {

using model::Nanoseconds;

inline constexpr std::int64_t ethernet_header_bytes = 14;
inline constexpr std::uint32_t most_stations = 10;

/// The two services of a frame; the numbers are those of the profile's stages.
enum class Direction : std::uint8_t { uplink = 0, downlink = 1 };
/// Whom a frame is for: its destination address tells.
enum class Cast : std::uint8_t { unicast = 0, multicast = 1 };

/// Most frames that may wait in one queue (the frame in service waits no more); none: unlimited.
struct QueueLimits {
  std::optional<std::uint64_t> station;   ///< frames of one station, for their uplink
  std::optional<std::uint64_t> downlink;  ///< frames at the access point, for their downlink
};

/// Independent losses: each downlink transmission is lost with this probability (0 … 1), drawn from
/// `seed` in the order in which they end. As the model has it, a lost frame takes all its airtime
/// and is not received; nobody repeats it.
struct Losses {
  double probability = 0;
  std::uint64_t seed = 0;
};

struct Frame {
  std::uint32_t station = 0;  ///< who sent it, from 0 on
  std::int64_t bytes = 0;     ///< with the Ethernet header, without its checksum
  Cast cast{};
  model::Flow flow = {};  ///< its conversation, if the profile keeps flows apart
  /// The station that a unicast frame is for; absent: the other one of two, or nobody knows.
  std::optional<std::uint32_t> receiver = {};

  /// Whose queue at the access point a unicast frame waits in.
  [[nodiscard]] std::uint32_t to() const { return receiver.value_or(station == 0 ? 1 : 0); }
};

/// What became of a frame at the end of a service.
enum class ServiceEnd : std::uint8_t {
  forwarded,  ///< uplink: it waits for its downlink
  dropped,    ///< by a queue, as the profile says; uplink also: that of the downlink was full
  delivered,  ///< downlink
  lost        ///< downlink
};

/// A service that has ended.
struct Service {
  std::uint32_t frame = 0;  ///< as `request` named it
  std::uint32_t station = 0;
  Direction direction{};
  Nanoseconds start;
  Nanoseconds end;
  ServiceEnd outcome{};
  /// Whom a frame was for; absent: all but its station, because it was multicast or nobody knows.
  std::optional<std::uint32_t> receiver = {};
};

/// What the channel has done; indices are direction and cast.
struct ChannelStatistics {
  struct Served {
    std::uint64_t frames = 0;
    std::int64_t bytes = 0;  ///< Ethernet bytes
    Nanoseconds busy;        ///< airtime
  };
  struct Station {
    std::uint64_t frames = 0;  ///< sent by it, also those that were dropped at once
    std::int64_t bytes = 0;
    std::uint64_t dropped = 0;
    std::uint64_t deepest_queue = 0;
  };

  std::array<std::array<Served, 2>, 2> served{};
  std::array<Station, most_stations> stations{};
  std::uint64_t delivered = 0;
  std::uint64_t lost = 0;
  std::uint64_t dropped_downlink = 0;
  std::uint64_t deepest_downlink_queue = 0;
  std::uint64_t deepest_queue = 0;  ///< frames that waited at once, in all queues
};

class HalfDuplexChannel {
 public:
  /// `wireless` must be one that `why_not_served` (serving_profile.hpp) accepts.
  HalfDuplexChannel(const model::WirelessProfile& wireless, const QueueLimits& limits,
                    const Losses& losses, std::uint32_t stations = 2);

  /// A station requests service for a frame at `now`, which is not before any earlier request and
  /// not before the time of an `advance`. Returns a number that names the frame, or nothing if the
  /// station's queue is full. Services that end by then end first, and several requests of one
  /// instant are all there before the channel chooses.
  std::optional<std::uint32_t> request(Nanoseconds now, const Frame& frame);

  /// All that happens up to and including `now`.
  void advance(Nanoseconds now);

  /// When the next thing happens without another request; nothing: the channel is idle.
  [[nodiscard]] std::optional<Nanoseconds> next_event() const;

  /// The services that have ended since the last call, in order. Unless it was `forwarded`, a frame
  /// that is among them may lose its name to the next request.
  [[nodiscard]] std::vector<Service> take_services();

  [[nodiscard]] const ChannelStatistics& statistics() const { return statistics_; }
  /// Frames that wait, and the one in service.
  [[nodiscard]] std::uint64_t frames_inside() const {
    return waiting() + (serving_ ? serving_->frames.size() : 0);
  }

 private:
  struct InService {
    std::vector<std::uint32_t> frames;  // one, or with `service: unit` one or several
    Direction direction{};
    Nanoseconds start;
    Nanoseconds end;
  };

  void run_until(Nanoseconds now, bool dispatch_now);
  template <class Event>
  void step();
  void serve();
  [[nodiscard]] InService choose_frame();
  [[nodiscard]] InService choose_unit();
  void finish();
  [[nodiscard]] std::size_t waiting() const { return units_ ? units_->size() : waiting_.size(); }
  [[nodiscard]] std::int64_t bytes_on_air(const Frame& frame) const {
    return frame.bytes - ethernet_header_bytes + link_overhead_bytes_;
  }
  void wait_for(Direction direction, std::uint32_t frame);
  void settle_drops();
  [[nodiscard]] ServiceEnd after_uplink(std::uint32_t frame);
  [[nodiscard]] ServiceEnd after_downlink();

  std::int64_t link_overhead_bytes_;
  std::array<std::array<model::MemoizedRate, 2>, 2> rate_;  // by direction and cast
  QueueLimits limits_;
  Losses losses_;
  std::mt19937_64 random_;

  fsm::Flyweight<fsm::Channel> machine_;
  fsm::StateId state_ = fsm::Flyweight<fsm::Channel>::initial;
  Nanoseconds now_;
  std::optional<Nanoseconds> dispatch_;  // when it is pending
  std::optional<InService> serving_;
  model::WaitingFragments waiting_;          // with `service: frame`
  std::optional<model::UnitChannel> units_;  // with `service: unit`
  std::array<std::uint64_t, most_stations> station_queue_{};
  std::uint64_t downlink_queue_ = 0;
  std::uint64_t next_request_ = 0;
  model::SlotPool<Frame> frames_;  // by name
  std::vector<Service> ended_;
  ChannelStatistics statistics_;
};

}  // namespace stormproof::live
