// The bounds follow the packets that each implementation builds: a message is closed before it
// exceeds its limit, unless one descriptor alone does; a piggybacked HEARTBEAT may come on top.
#include "model/config/knobs/largest_packet.hpp"

#include <algorithm>

#include "model/cyclone/endpoints.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/engine/profiles.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/fastdds/types.hpp"
#include "model/implementations.hpp"

namespace stormproof::model::config {
namespace {

/// UDP payload of the bitmap of an ACKNACK that misses everything: four bytes for every 32
/// descriptors.
Bytes largest_bitmap(const Scenario& scenario) {
  std::uint32_t most = 0;
  for (const Participant& participant : scenario.deployment.participants) {
    most = std::max({most, participant.publications, participant.subscriptions});
  }
  const DescriptorProfile& descriptors = scenario.dds.descriptors;
  most += std::max(descriptors.default_publications, descriptors.default_subscriptions);
  return Bytes{std::int64_t{4} * ((most + 31) / 32)};
}

LargestPacket largest_of(Of<fsm::composition::paper::Paper>, const Scenario& scenario) {
  const SedpProfile& sedp = scenario.dds.sedp;
  const DescriptorProfile& descriptors = scenario.dds.descriptors;
  const Bytes heartbeat =
      sedp.piggyback == Piggyback::off ? Bytes{0} : sedp.piggyback_heartbeat_bytes;
  const LargestPacket candidates[] = {
      {sedp.grouping == Grouping::message ? sedp.grouping_limit_bytes + heartbeat : Bytes{0},
       "dds.sedp.grouping_limit_bytes"},
      {std::max(descriptors.default_bytes[0], descriptors.default_bytes[1]) + heartbeat,
       "dds.descriptors.default_bytes"},
      {descriptors.user_bytes + heartbeat, "dds.descriptors.user_bytes"},
      {scenario.dds.spdp.payload_bytes, "dds.spdp.payload_bytes"},
      {sedp.heartbeat_bytes, "dds.sedp.heartbeat_bytes"},
      {sedp.acknack_bytes + largest_bitmap(scenario), "dds.sedp.acknack_bytes"}};
  return *std::ranges::max_element(candidates, {}, &LargestPacket::payload);
}

LargestPacket largest_of(Of<fsm::composition::fastdds::FastDds>, const Scenario& scenario) {
  const DdsProfile dds = fastdds::deployed_profile(scenario);
  const auto& types = scenario.deployment.types;
  const bool asks_for_all = dds.version.typelookup_unit == LookupUnit::participant;
  const std::int64_t sample =
      types ? fastdds::largest_sample_bytes(dds, asks_for_all ? fastdds::most_types(*types) : 1)
            : 0;
  const std::int64_t alone = fastdds::message_header_bytes + fastdds::destination_bytes +
                             fastdds::timestamp_bytes +
                             std::max(fastdds::largest_submessage_bytes(dds), sample);
  const std::int64_t message = std::max(dds.sedp.grouping_limit_bytes.count(), alone);
  return {Bytes{message + fastdds::heartbeat_submessage_bytes} + dds.version.statistics_bytes,
          "dds.sedp.grouping_limit_bytes"};
}

/// Those of a client; the server sends one descriptor at a time.
LargestPacket largest_of(Of<fsm::composition::server::FastDdsServer>, const Scenario& scenario) {
  LargestPacket largest = largest_of(Of<fsm::composition::fastdds::FastDds>{}, scenario);
  largest.payload += Bytes{fastdds::sizes_of(scenario.dds).inline_qos};
  return largest;
}

/// A message is never split: alone it may exceed the size that packets are filled to.
LargestPacket largest_of(Of<fsm::composition::cyclone::Cyclone>, const Scenario& scenario) {
  const Bytes header{cyclone::header_bytes + cyclone::destination_bytes};
  const LargestPacket candidates[] = {
      {scenario.dds.sedp.max_message_size, "dds.sedp.max_message_size"},
      {scenario.dds.sedp.max_rexmit_message_size, "dds.sedp.max_rexmit_message_size"},
      {header + Bytes{cyclone::largest_submessage_bytes}, "an announcement"},
      {header + Bytes{cyclone::acknack_bytes} + largest_bitmap(scenario), "an ACKNACK"}};
  return *std::ranges::max_element(candidates, {}, &LargestPacket::payload);
}

}  // namespace

LargestPacket largest_packet(const Scenario& scenario) {
  const auto largest = [](const Scenario& one) {
    return visit_composition(one.dds,
                             [&](auto composition) { return largest_of(composition, one); });
  };
  if (!is_mixed(scenario)) return largest(scenario);
  std::vector<LargestPacket> of_each;
  const Profiles profiles{scenario};
  for (const DdsProfile& dds : profiles.different()) {
    Scenario one = scenario;
    one.dds = dds;
    of_each.push_back(largest(one));
  }
  return *std::ranges::max_element(of_each, {}, &LargestPacket::payload);
}

}  // namespace stormproof::model::config
