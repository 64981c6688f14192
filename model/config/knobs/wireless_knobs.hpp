// The table of the wireless profile: every key, its range and its meaning, in the order of the
// file. See knobs.hpp for what visits it.
#pragma once

#include <fmt/core.h>

#include "model/airtime.hpp"
#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::model::config {

template <>
inline constexpr std::array<std::string_view, 2> enum_names<ServiceKind>{"shared_channel",
                                                                         "constant_delay"};
template <>
inline constexpr std::array<std::string_view, 4> enum_names<ServiceOrder>{
    "fifo_uplink", "fifo_downlink", "fifo", "datagram_uplink"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<FragmentRequest>{"sequential",
                                                                             "at_admission"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<MulticastAs>{"unicast", "multicast"};

template <>
inline constexpr std::array<std::string_view, 2> enum_names<ServedBy>{"frame", "unit"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Arbitration>{"round_robin", "oldest"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<ApQueue>{"oldest", "round_robin"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Queueing>{"fifo", "flows"};
template <>
inline constexpr std::array<std::string_view, 4> enum_names<QueueDiscipline>{
    "unlimited", "tail_drop", "codel", "fq_codel"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<QueuesOf>{"everybody", "access_points",
                                                                      "stations"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Sender>{"backlog", "stalls"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<CountAt>{"generation", "admission"};

/// The airtime of a fragment is computed as 8·B·10^9 + R/2 with B = payload + 20 + link overhead.
/// With these two limits B stays below 1.1·10^9 + 21, and the sum (R up to 10^15) below 2^63
/// = 9.2·10^18.
inline constexpr NumberType mtu_range = byte_range(1, 1'000'000'000);
inline constexpr NumberType link_overhead_range = byte_range(0, 100'000'000);

void visit_knobs(auto& visit, Is<Stage> auto& stage) {
  visit.knob("name", stage.name, TextType{}, "name in traces and reports");
  visit.knob("channel", stage.channel, TextType{},
             "stages with the same channel share its airtime");
  visit.knob("multicast_as", stage.multicast_as, ChoiceType<MulticastAs>{},
             "how a multicast packet is served in this stage");
  visit.knob("overhead_unicast", stage.overhead_unicast, delay_range,
             "replaces the profile's value in this stage", Presence::optional);
  visit.knob("overhead_multicast", stage.overhead_multicast, delay_range,
             "replaces the profile's value in this stage", Presence::optional);
  visit.knob("rate_unicast", stage.rate_unicast, rate_range,
             "replaces the profile's value in this stage", Presence::optional);
  visit.knob("rate_multicast", stage.rate_multicast, rate_range,
             "replaces the profile's value in this stage", Presence::optional);
}

/// Numbers of packets, in `lost_packets` and `packet_delays`.
inline constexpr NumberType packet_number = count_range(0, 1'000'000'000'000'000);
inline constexpr std::size_t max_packet_delays = 1'000'000;
inline constexpr std::string_view packet_delays_key = "packet_delays";
inline constexpr std::string_view packet_key = "packet";

void visit_knobs(auto& visit, Is<PacketDelay> auto& delay) {
  visit.knob(packet_key, delay.packet, packet_number, "its number, by emission order from 0");
  visit.knob("leaves_after", delay.leaves_after, delay_range,
             "from its emission until it has left its source; 0 if absent", Presence::optional);
  visit.knob("one_way", delay.one_way, delay_range, "from its emission until its reception");
  visit.rule(delay.leaves_after <= delay.one_way, "leaves_after",
             "at most the one_way of the same packet");
}

void visit_knobs(auto& visit, Is<Aggregation> auto& aggregation) {
  const Presence defaulted = Presence::defaulted;
  visit.knob("max_frames", aggregation.max_frames, count_range(1, 1'000'000),
             "frames of a unit; 64 if absent", defaulted);
  visit.knob("max_bytes", aggregation.max_bytes, byte_range(1, 1'000'000'000),
             "bytes of a unit, with delimiters and padding; 65535 if absent", defaulted);
  visit.knob("max_airtime", aggregation.max_airtime, delay_range,
             "how long these bytes take; 5.484ms if absent", defaulted);
  visit.knob("overhead", aggregation.overhead, delay_range,
             "channel access and protocol cost of several frames (O_a); 198.5us if absent",
             defaulted);
}

void visit_knobs(auto& visit, Is<LossBursts> auto& bursts) {
  visit.knob("begin", bursts.begin, RatioType{1},
             "probability that a usual link gets worse before a transmission");
  visit.knob("end", bursts.end, RatioType{1},
             "probability that a worse link recovers before a transmission");
  visit.knob("probability", bursts.probability, RatioType{1},
             "probability that a transmission fails on a worse link");
}

void visit_knobs(auto& visit, Is<FrameLoss> auto& loss) {
  visit.knob("probability", loss.probability, RatioType{1},
             "probability that the transmission of a frame fails, on a usual link");
  visit.knob("retries", loss.retries, count_range(0, 255),
             "transmissions of a unicast frame after the first, at most; 7 if absent",
             Presence::optional);
  visit.knob("seed", loss.seed, SeedType{}, "of the draws; 0 if absent", Presence::optional);
  visit.section("bursts", loss.bursts, "periods in which a link is worse (Gilbert and Elliott)",
                Presence::optional);
}

void visit_knobs(auto& visit, Is<QueueManagement> auto& queue) {
  visit.knob("discipline", queue.discipline, ChoiceType<QueueDiscipline>{},
             "which frames are dropped: none, those that find no room, those that waited for too "
             "long (RFC 8289), or those of each flow (RFC 8290)");
  visit.knob("of", queue.of, UsualChoiceType<QueuesOf>{{}, QueuesOf::everybody},
             "whose queues: everybody's if absent, those of access points or of stations",
             Presence::defaulted);
  visit.knob("max_frames", queue.max_frames, count_range(1, 1'000'000'000),
             "frames that wait at a transmitter; any number if absent", Presence::optional);
  visit.knob("max_bytes", queue.max_bytes, byte_range(1, 1'000'000'000'000),
             "bytes on the channel of these; any number if absent", Presence::optional);
  visit.knob("target", queue.target, delay_range,
             "how long a frame may wait, with codel and fq_codel; 5ms if absent",
             Presence::defaulted);
  visit.knob("interval", queue.interval, period_range,
             "how long frames may wait for longer before one is dropped; 100ms if absent",
             Presence::defaulted);
  visit.rule(queue.discipline != QueueDiscipline::tail_drop || queue.max_frames || queue.max_bytes,
             "discipline", "max_frames or max_bytes, or another discipline than tail_drop");
}

inline constexpr std::string_view service_key = "service";
inline constexpr std::string_view loss_key = "loss";
inline constexpr std::string_view queue_key = "queue";

/// From a host to its access point, and from there on, over one channel or two.
[[nodiscard]] inline bool goes_over_access_point(const WirelessProfile& wireless) {
  return wireless.kind == ServiceKind::shared_channel &&
         (wireless.service == ServedBy::unit || wireless.stages.size() == 2);
}

/// Flows are kept apart where they are dropped from, and nowhere else; whatever arrives fits alone.
void visit_queue(auto& visit, Is<WirelessProfile> auto& wireless, Presence presence) {
  visit.section(queue_key, wireless.queue,
                "which frames that wait for the channel are dropped; none if absent", presence);
  if (!queues_drop(wireless)) return;
  const bool of_flows = wireless.queue->discipline == QueueDiscipline::fq_codel;
  visit.rule(of_flows == (wireless.queueing == Queueing::flows), "queue.discipline",
             "fq_codel with queueing: flows, or tail_drop or codel with queueing: fifo");
  const std::int64_t longest = Fragmentation{wireless}.longest();
  visit.rule(!wireless.queue->max_bytes || wireless.queue->max_bytes->count() >= longest,
             "queue.max_bytes", fmt::format("at least {}, the bytes of a full frame", longest));
}

/// What only `service: unit` has.
void visit_unit_knobs(auto& visit, Is<WirelessProfile> auto& wireless) {
  const bool by_unit = wireless.service == ServedBy::unit;
  const Presence presence = by_unit ? Presence::defaulted : Presence::of_others;
  visit.section("aggregation", wireless.aggregation,
                "what fits into one access; that of 802.11n if absent", presence);
  visit.knob("arbitration", wireless.arbitration, ChoiceType<Arbitration>{},
             "whether transmitters take turns, as they do if absent, or the oldest request is next",
             presence);
  visit.knob("ap_queue", wireless.ap_queue, ChoiceType<ApQueue>{},
             "whether the access point's next queue is that of the oldest request, as it is if "
             "absent, or they take turns, as they always do with queueing: flows",
             presence);
  visit.knob("queueing", wireless.queueing, ChoiceType<Queueing>{},
             "whether frames wait in one line, as they do if absent, or in one for each flow",
             presence);
  visit.knob("quantum", wireless.quantum, byte_range(1, 1'000'000'000),
             "bytes that a flow may send before the next one; 300 if absent", presence);
  visit_queue(visit, wireless, by_unit ? Presence::optional : Presence::of_others);
  visit.rule(!by_unit || wireless.arbitration == Arbitration::round_robin ||
                 (wireless.queueing == Queueing::fifo && wireless.ap_queue == ApQueue::oldest),
             "arbitration", "round_robin, or queueing: fifo with ap_queue: oldest");
  visit.rule(!by_unit || wireless.kind == ServiceKind::shared_channel, "kind",
             "shared_channel, or service: frame");
  visit.rule(!by_unit || wireless.fragment_request == FragmentRequest::at_admission,
             "fragment_request", "at_admission, or service: frame");
}

void visit_knobs(auto& visit, Is<WirelessProfile> auto& wireless) {
  visit.knob("kind", wireless.kind, ChoiceType<ServiceKind>{},
             "a channel that is shared, or a fixed delay");
  const bool is_shared =
      wireless.kind == ServiceKind::shared_channel || wireless.service == ServedBy::unit;
  const Presence of_channel = is_shared ? Presence::required : Presence::optional;
  const Presence of_delay = is_shared ? Presence::optional : Presence::required;
  visit.knob(
      service_key, wireless.service, UsualChoiceType<ServedBy>{{}, ServedBy::frame},
      "whether an access to the channel serves one frame, as it does if absent, or a unit of "
      "several between hosts and an access point",
      Presence::defaulted);
  const bool by_unit = wireless.service == ServedBy::unit;
  const Presence of_frames = by_unit ? Presence::of_others : of_channel;

  visit.knob("overhead_unicast", wireless.overhead_unicast, delay_range,
             "channel access and protocol cost of a unicast fragment (O_u)", of_channel);
  visit.knob("overhead_multicast", wireless.overhead_multicast, delay_range,
             "channel access and protocol cost of a multicast fragment (O_m)", of_channel);
  visit.knob("rate_unicast", wireless.rate_unicast, rate_range,
             "physical-layer rate of unicast (R_u)", of_channel);
  visit.knob("rate_multicast", wireless.rate_multicast, rate_range,
             "physical-layer rate of multicast (R_m)", of_channel);
  visit.knob("link_overhead_bytes", wireless.link_overhead_bytes, link_overhead_range,
             "link-layer bytes of a fragment, on top of its IP header", of_channel);
  visit.knob("mtu_payload_bytes", wireless.mtu_payload_bytes, mtu_range,
             "IP payload bytes of a full fragment", of_channel);
  visit.knob(
      "source_queue_bytes", wireless.source_queue_bytes,
      BytesOrWordType{byte_range(1, 1'000'000'000'000), "unlimited", WirelessProfile::unlimited},
      "capacity of a participant's source queue (W)", of_channel);
  visit.knob("order", wireless.order, ChoiceType<ServiceOrder>{},
             "which stage goes first among fragments that wait since the same instant", of_frames);
  visit.knob("fragment_request", wireless.fragment_request, ChoiceType<FragmentRequest>{},
             "whether admission requests service for the first fragment or for all",
             by_unit ? Presence::optional : of_channel);
  visit.knob("lost_packets", wireless.lost_packets, NumberSetType{packet_number},
             "packets that are not received, by emission order from 0", Presence::optional);
  visit.knob("one_way", wireless.one_way, delay_range,
             "delay of every packet with kind: constant_delay", of_delay);
  visit.list(packet_delays_key, wireless.packet_delays, ListSize{0, max_packet_delays},
             "packets with delays of their own, with kind: constant_delay", Presence::optional);
  visit.rule(!is_shared || wireless.packet_delays.empty(), packet_delays_key,
             "no such list, or kind: constant_delay");
  visit.list("stages", wireless.stages, ListSize{1, WirelessProfile::max_stages},
             "the route of every packet, in order", of_frames);
  visit_unit_knobs(visit, wireless);
  visit.section(loss_key, wireless.loss, "transmissions that fail; none if absent",
                Presence::optional);
  visit.rule(!wireless.loss || goes_over_access_point(wireless), loss_key,
             "no such key, or a shared_channel of two stages, to the access point and from it");
  visit.knob(
      "sender", wireless.sender, UsualChoiceType<Sender>{{}, Sender::backlog},
      "whether a participant with packets that wait for its source queue goes on, as it does "
      "if absent, or waits with them",
      Presence::defaulted);
  visit.knob("count_at", wireless.count_at, UsualChoiceType<CountAt>{{}, CountAt::generation},
             "whether messages count at their generation, as they do if absent, or when they are "
             "admitted to the source queue",
             Presence::defaulted);
}

}  // namespace stormproof::model::config
