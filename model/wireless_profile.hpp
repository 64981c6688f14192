// The wireless profile: how packets are served, from the source queue over the stages of the route
// to the receiver (paper, "Shared Wireless Service"; specs/guide/model.md, "Packets, fragments,
// queue, channel"; with `service: unit` specs/guide/wifi.md). The defaults are infrastructure
// 802.11n as in the paper's evaluation. `model/config/knobs/wireless_knobs.hpp` gives keys and
// ranges.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/limits.hpp"
#include "model/units.hpp"

namespace stormproof::model {

enum class ServiceKind : std::uint8_t { shared_channel, constant_delay };
/// Which stage goes first when several fragments wait since the same instant.
enum class ServiceOrder : std::uint8_t { fifo_uplink, fifo_downlink, fifo, datagram_uplink };
/// Whether admission requests service for the first fragment only or for all of them.
enum class FragmentRequest : std::uint8_t { sequential, at_admission };
enum class MulticastAs : std::uint8_t { unicast, multicast };

/// What an access to the channel serves: one fragment, on a route of stages; or a unit of frames
/// (A-MPDU) between hosts and their access point.
enum class ServedBy : std::uint8_t { frame, unit };
/// Which transmitter is next: the one that has not sent for the longest time, or that of the oldest
/// request.
enum class Arbitration : std::uint8_t { round_robin, oldest };
/// Which of its queues the access point serves next.
enum class ApQueue : std::uint8_t { oldest, round_robin };
/// Whether the frames of a queue wait in one line, or in one for each flow (Linux mac80211).
enum class Queueing : std::uint8_t { fifo, flows };
/// Which frames a queue drops: none, those that find no room (tc's pfifo and bfifo), those that
/// waited for too long (RFC 8289), or the same in each flow, and the longest flow's at the limit
/// (RFC 8290).
enum class QueueDiscipline : std::uint8_t { unlimited, tail_drop, codel, fq_codel };
/// Whose queues drop frames: everybody's, those of the access points (on the way down), or those of
/// the stations (on the way up).
enum class QueuesOf : std::uint8_t { everybody, access_points, stations };
/// What a participant does while packets wait for room in its source queue: it goes on, or its
/// thread waits with them, as a blocking socket makes it.
enum class Sender : std::uint8_t { backlog, stalls };
/// Whether a message counts when it is generated, or when it is admitted to the source queue.
enum class CountAt : std::uint8_t { generation, admission };

/// What fits into one unit, and what an access with several frames costs beside their airtime. The
/// defaults are those of 802.11n: Block Ack window, A-MPDU length, PPDU duration.
struct Aggregation {
  std::uint32_t max_frames = 64;
  Bytes max_bytes{65'535};
  Nanoseconds max_airtime{5'484'000};
  Nanoseconds overhead{198'500};

  bool operator==(const Aggregation&) const = default;
};

/// Periods in which a link is worse than usual (Gilbert and Elliott): before each transmission it
/// gets worse, or recovers, with a probability.
struct LossBursts {
  Ratio begin;        ///< probability that a usual link gets worse
  Ratio end;          ///< that one recovers
  Ratio probability;  ///< that a transmission fails meanwhile

  bool operator==(const LossBursts&) const = default;
};

/// Transmissions that fail, from a seed. Each station has a link of its own, for both directions.
struct FrameLoss {
  Ratio probability;          ///< that one transmission of a frame fails
  std::uint32_t retries = 7;  ///< transmissions of a unicast frame after the first, at most
  std::uint64_t seed = 0;
  std::optional<LossBursts> bursts = {};

  bool operator==(const FrameLoss&) const = default;
};

/// How queues of frames that wait for the channel drop some. The limits are of a transmitter, over
/// all its queues; the defaults those of RFC 8289.
struct QueueManagement {
  QueueDiscipline discipline = QueueDiscipline::unlimited;
  QueuesOf of = QueuesOf::everybody;
  std::optional<std::uint32_t> max_frames = {};
  std::optional<Bytes> max_bytes = {};
  Nanoseconds target{5'000'000};      ///< a frame may wait for so long
  Nanoseconds interval{100'000'000};  ///< and longer for as long as this

  bool operator==(const QueueManagement&) const = default;
};

/// One stage of the route. An override that is absent means: the value of the profile.
struct Stage {
  std::string name;
  std::string channel;  ///< stages with the same channel name share its airtime
  MulticastAs multicast_as = MulticastAs::unicast;
  std::optional<Nanoseconds> overhead_unicast;
  std::optional<Nanoseconds> overhead_multicast;
  std::optional<BitsPerSecond> rate_unicast;
  std::optional<BitsPerSecond> rate_multicast;

  bool operator==(const Stage&) const = default;
};

/// How long one packet takes with `constant_delay`, instead of the profile's `one_way`. A schedule
/// of such delays is how a proof or a search tells what the network did.
struct PacketDelay {
  std::uint64_t packet = 0;  ///< number in emission order, from 0
  Nanoseconds leaves_after;  ///< from its emission until it has left the source; at most `one_way`
  Nanoseconds one_way;       ///< from its emission until its reception

  bool operator==(const PacketDelay&) const = default;
};

struct WirelessProfile {
  /// Value of `source_queue_bytes` that stands for "no limit"; the key then reads `unlimited`.
  static constexpr Bytes unlimited{std::numeric_limits<std::int64_t>::max()};
  static constexpr std::uint32_t max_stages = 32;

  ServiceKind kind = ServiceKind::shared_channel;
  Nanoseconds overhead_unicast{194'500};
  Nanoseconds overhead_multicast{130'500};
  BitsPerSecond rate_unicast{144'400'000};
  BitsPerSecond rate_multicast{6'000'000};
  Bytes link_overhead_bytes{38};
  Bytes mtu_payload_bytes{1'480};
  Bytes source_queue_bytes{212'992};  ///< W; `unlimited` admits everything at once
  ServiceOrder order = ServiceOrder::fifo_uplink;
  FragmentRequest fragment_request = FragmentRequest::sequential;
  std::vector<std::uint64_t>
      lost_packets;        ///< packet numbers in emission order, ascending, no duplicates
  Nanoseconds one_way{0};  ///< delay of `constant_delay`
  std::vector<PacketDelay> packet_delays;  ///< exceptions to it, by ascending packet number
  std::vector<Stage> stages{{"uplink", "air", MulticastAs::unicast, {}, {}, {}, {}},
                            {"downlink", "air", MulticastAs::multicast, {}, {}, {}, {}}};
  ServedBy service = ServedBy::frame;
  // Of `service: unit`, whose stages are the two above.
  Aggregation aggregation;
  Arbitration arbitration = Arbitration::round_robin;
  ApQueue ap_queue = ApQueue::oldest;
  Queueing queueing = Queueing::fifo;
  Bytes quantum{300};  ///< bytes that a flow may send before the next one does (Linux fq_impl.h)
  std::optional<QueueManagement> queue = {};
  // Of both.
  std::optional<FrameLoss> loss = {};  ///< of the two stages above
  Sender sender = Sender::backlog;
  CountAt count_at = CountAt::generation;

  bool operator==(const WirelessProfile&) const = default;
};

/// Whether queues drop frames.
[[nodiscard]] inline bool queues_drop(const WirelessProfile& wireless) {
  return wireless.queue && wireless.queue->discipline != QueueDiscipline::unlimited;
}

}  // namespace stormproof::model
