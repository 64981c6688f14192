// The knobs of the paper's profiles, and the constants of Fast DDS's source code.
#include "model/packet_sizes.hpp"

#include "model/cyclone/endpoints.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"

namespace stormproof::model {

namespace {

constexpr std::int64_t bitmap_word_bytes = 4;  // an ACKNACK that asks for something

PacketSizes sizes_of(Of<fsm::composition::paper::Paper>, const DdsProfile& dds) {
  const SedpProfile sedp = dds.sedp;
  const std::int64_t header = sedp.shared_header_bytes.count();
  return {.announcement = dds.spdp.payload_bytes.count(),
          .heartbeat = sedp.heartbeat_bytes.count(),
          .acknack = sedp.acknack_bytes.count() + bitmap_word_bytes,
          .header = header,
          .heartbeat_in_data = sedp.piggyback_heartbeat_bytes.count(),
          .descriptor = [sizes = DescriptorSizes{dds.descriptors}, header](
                            Stream s, std::uint32_t d) { return sizes.bytes(s, d) - header; },
          .is_full = [sedp](std::int64_t payload,
                            std::int64_t added) { return packet_is_full(sedp, payload, added); }};
}

PacketSizes sizes_of(Of<fsm::composition::fastdds::FastDds>, const DdsProfile& dds) {
  const std::int64_t statistics = dds.version.statistics_bytes.count();
  return {
      .announcement = fastdds::sizes_of(dds).announcement + statistics,
      .heartbeat = fastdds::heartbeat_to_one_bytes + statistics,
      .acknack = fastdds::acknack_bytes + fastdds::acknack_bitmap_bytes + statistics,
      .header = fastdds::message_header_bytes + statistics,
      .destination = fastdds::destination_bytes,
      .heartbeat_in_data = fastdds::heartbeat_submessage_bytes,
      .descriptor =
          [dds](Stream s, std::uint32_t d) {
            return fastdds::timestamp_bytes + fastdds::submessage_bytes(dds, s, d);
          },
      // What the statistics module adds does not count.
      .is_full = [limit = dds.sedp.grouping_limit_bytes.count() + statistics](
                     std::int64_t payload, std::int64_t added) { return payload + added > limit; }};
}

/// Of what a client sends to the server.
PacketSizes sizes_of(Of<fsm::composition::server::FastDdsServer>, const DdsProfile& dds) {
  PacketSizes sizes = sizes_of(Of<fsm::composition::fastdds::FastDds>{}, dds);
  sizes.descriptor = [dds](Stream s, std::uint32_t d) {
    return fastdds::timestamp_bytes + fastdds::sizes_of(dds).inline_qos +
           fastdds::submessage_bytes(dds, s, d);
  };
  return sizes;
}

/// Of packets with one submessage.
PacketSizes sizes_of(Of<fsm::composition::cyclone::Cyclone>, const DdsProfile& dds) {
  const bool multicast = dds.allow_multicast == AllowMulticast::always;
  return {
      .announcement =
          cyclone::header_bytes +
          (multicast ? cyclone::announcement_with_multicast_bytes : cyclone::announcement_bytes),
      .heartbeat = cyclone::header_bytes + cyclone::destination_bytes + cyclone::heartbeat_bytes,
      .acknack = cyclone::header_bytes + cyclone::destination_bytes + cyclone::acknack_bytes +
                 cyclone::bitmap_word_bytes,
      .header = cyclone::header_bytes,
      .destination = cyclone::destination_bytes,
      .heartbeat_in_data = cyclone::heartbeat_bytes,
      .descriptor =
          [](Stream s, std::uint32_t d) {
            return cyclone::data_bytes(
                s == Stream::pub ? cyclone::writer::publications : cyclone::writer::subscriptions,
                d);
          },
      .is_full = [limit = dds.sedp.max_rexmit_message_size.count()](
                     std::int64_t payload, std::int64_t added) { return payload + added > limit; }};
}

}  // namespace

PacketSizes packet_sizes(const DdsProfile& dds) {
  return visit_composition(dds, [&](auto composition) { return sizes_of(composition, dds); });
}

}  // namespace stormproof::model
