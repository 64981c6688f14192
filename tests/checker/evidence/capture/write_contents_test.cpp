// What the messages of a simulated capture say: names, addresses, counts of HEARTBEATs, and what
// becomes of sizes that no valid message has.
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/write/capture_probe.hpp"
#include "checker/evidence/capture/write/identities.hpp"
#include "tests/checker/evidence/capture/write_comparison.hpp"
#include "tests/vectors/fastdds_vectors.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::capture::testing {
namespace write_contents_test {

model::Scenario scenario_of(model::Deployment deployment, const model::Scenario& like) {
  model::Scenario scenario = like;
  scenario.deployment = std::move(deployment);
  return scenario;
}

model::Scenario fastdds(std::uint32_t hosts, std::uint32_t participants, std::uint32_t endpoints) {
  return scenario_of(model::Deployment::homogeneous(hosts, participants, endpoints),
                     vectors::fastdds_vectors().front().scenario);
}
model::Scenario paper(std::uint32_t hosts, std::uint32_t participants, std::uint32_t endpoints) {
  return scenario_of(model::Deployment::homogeneous(hosts, participants, endpoints),
                     vectors::paper_vectors().front().scenario);
}

TEST(WriteContents, ParticipantsHaveNamesAddressesAndAVendor) {
  const Conversation conversation = conversation_in(simulated_capture(fastdds(3, 2, 3)));
  const Topology& topology = conversation.topology;
  ASSERT_EQ(topology.hosts, 3U);
  ASSERT_EQ(topology.participants.size(), 6U);
  const Participant& last = topology.participants.back();
  EXPECT_EQ(last.name, "simulated_h2_p1");
  EXPECT_EQ(to_string(last.prefix), "010f0002.00000006.00000000");
  EXPECT_EQ(last.vendor, fastdds_vendor);
  ASSERT_EQ(last.locators.size(), 1U);
  EXPECT_EQ(to_string(*last.locators.begin()), "10.0.2.1:7412");
  EXPECT_EQ(conversation.first_ns, simulated_epoch_ns);
  const Conversation of_paper = conversation_in(simulated_capture(paper(2, 1, 2)));
  EXPECT_EQ(of_paper.topology.participants.front().vendor, simulated_vendor);
  EXPECT_EQ(vendor_name(simulated_vendor), "vendor 53.50");
}

TEST(WriteContents, EndpointsAreThoseOfARosNodeAndTheUsers) {
  const Conversation conversation = conversation_in(simulated_capture(fastdds(2, 1, 3)));
  std::multiset<std::string> topics;
  const Participant& first = conversation.topology.participants.front();
  for (const auto& [guid, endpoint] : first.endpoints) {
    EXPECT_EQ(endpoint.qos.is_reliable, true);
    EXPECT_EQ(guid.entity & 0xffU,
              endpoint.announced_by == entity::publications_writer ? 0x03U : 0x04U);
    topics.insert(endpoint.topic + " " + endpoint.type);
  }
  EXPECT_EQ(topics.size(), 20U);
  const auto has = [&topics](const char* name) { return topics.count(name); };
  EXPECT_EQ(has("ros_discovery_info rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"), 2U);
  EXPECT_EQ(has("rt/rosout rcl_interfaces::msg::dds_::Log_"), 1U);
  EXPECT_EQ(has("rt/parameter_events rcl_interfaces::msg::dds_::ParameterEvent_"), 2U);
  EXPECT_EQ(has("rr/simulated_h0_p0/set_parameters_atomicallyReply "
                "rcl_interfaces::srv::dds_::SetParametersAtomically_Response_"),
            1U);
  EXPECT_EQ(has("rq/simulated_h0_p0/list_parametersRequest "
                "rcl_interfaces::srv::dds_::ListParameters_Request_"),
            1U);
  EXPECT_EQ(has("rt/bench/topic_00 std_msgs::msg::dds_::String_"), 2U);
  EXPECT_EQ(has("rt/bench/topic_01 std_msgs::msg::dds_::String_"), 1U);
}

TEST(WriteContents, CopiesOfAHeartbeatShareItsCount) {
  const Conversation conversation = conversation_in(simulated_capture(fastdds(2, 3, 20)));
  std::map<std::pair<GuidPrefix, EntityId>, std::uint32_t> last;
  std::map<std::tuple<GuidPrefix, EntityId, std::uint32_t>, std::set<GuidPrefix>> copies;
  std::size_t with_copies = 0;
  for (const Event& event : conversation.events) {
    if (event.heartbeat() == nullptr) continue;
    const std::uint32_t count = event.heartbeat()->count;
    std::uint32_t& before = last[{event.source, event.writer}];
    auto& destinations = copies[{event.source, event.writer, count}];
    EXPECT_TRUE(destinations.insert(*event.destination).second);
    const bool is_copy = destinations.size() > 1;
    if (is_copy) ++with_copies;
    EXPECT_TRUE(is_copy ? !event.has_info_dst : count > before) << count << " after " << before;
    before = count;
  }
  EXPECT_GT(with_copies, 0U);
}

/// Also where participants have different numbers of publications and subscriptions.
TEST(WriteContents, UserTrafficIsBetweenEndpointsOfOneTopic) {
  model::Deployment deployment = model::Deployment::homogeneous(2, 2, 0);
  deployment.participants[0].publications = 4;
  deployment.participants[1].subscriptions = 2;
  deployment.participants[2].subscriptions = 3;
  deployment.participants[3].publications = 1;
  const model::Scenario scenario =
      scenario_of(deployment, vectors::fastdds_vectors().front().scenario);
  const Conversation conversation = conversation_in(simulated_capture(scenario));
  std::set<std::string> topics;
  const auto topic = [&](const GuidPrefix& prefix, EntityId entity) {
    const auto& endpoints = conversation.topology.find(prefix)->endpoints;
    const auto found = endpoints.find(Guid{prefix, entity});
    return found == endpoints.end() ? "none" : found->second.topic;
  };
  for (const Event& event : conversation.events) {
    if (event.traffic() != Traffic::user) continue;
    const bool from_writer = event.heartbeat() != nullptr;
    const GuidPrefix writer = from_writer ? event.source : *event.destination;
    const GuidPrefix reader = from_writer ? *event.destination : event.source;
    topics.insert(topic(writer, event.writer));
    EXPECT_EQ(topic(writer, event.writer), topic(reader, event.reader));
  }
  EXPECT_EQ(topics,
            (std::set<std::string>{"ros_discovery_info", "rt/bench/topic_00", "rt/bench/topic_01",
                                   "rt/bench/topic_02", "rt/parameter_events"}));
}

TEST(WriteContents, AcknacksOfAReaderAreCountedOneByOne) {
  const Conversation conversation = conversation_in(simulated_capture(paper(2, 2, 10)));
  std::map<std::pair<GuidPrefix, EntityId>, std::uint32_t> last;
  std::size_t acknacks = 0;
  for (const Event& event : conversation.events) {
    if (event.acknack() == nullptr) continue;
    EXPECT_EQ(event.acknack()->count, (++last[{event.source, event.reader}]));
    ++acknacks;
  }
  EXPECT_GT(acknacks, 8U);
}

/// The model may have packets that are smaller than any message with that content.
TEST(WriteContents, ImpossibleSizesBecomeTheSmallestPossibleOnes) {
  model::Scenario scenario = paper(2, 1, 2);
  scenario.dds.spdp.payload_bytes = model::Bytes{1};
  scenario.dds.sedp.heartbeat_bytes = model::Bytes{66};
  scenario.dds.sedp.acknack_bytes = model::Bytes{10};
  scenario.dds.descriptors.default_bytes = {model::Bytes{100}, model::Bytes{101}};
  const SimulatedCapture capture = simulated_capture(scenario);
  const Conversation conversation = conversation_in(capture);
  EXPECT_EQ(difference(scenario, capture.run, conversation), "");
  for (const Event& event : conversation.events) {
    const std::uint32_t payload = conversation.datagrams[event.datagram].payload_bytes;
    const bool is_alone = payload < 100;
    EXPECT_TRUE(event.traffic() != Traffic::spdp || payload > 150U);
    EXPECT_TRUE(event.heartbeat() == nullptr || !is_alone || payload == 68U);
    EXPECT_TRUE(event.acknack() == nullptr || payload >= 64U);
  }
}

TEST(WriteContents, WhatDoesNotFitInADatagramGoesInSeveral) {
  for (const std::uint32_t endpoints : {700U, 6000U}) {
    model::Scenario scenario = paper(2, 1, endpoints);
    scenario.dds.descriptors.user_bytes = model::Bytes{40};
    scenario.dds.sedp.piggyback_threshold_bytes = model::Bytes{1};
    const auto [capture, emissions] = recorded(scenario);
    const Conversation conversation = conversation_in(capture);
    EXPECT_EQ(difference(scenario, capture.run, conversation), "");
    EXPECT_GT(conversation.datagrams.size(), emissions.size());
    std::uint32_t largest = 0;
    for (const DatagramRecord& one : conversation.datagrams) {
      largest = std::max(largest, one.payload_bytes);
      EXPECT_GT(one.payload_bytes, 52U);
    }
    EXPECT_GT(largest, 65'000U);
    EXPECT_LE(largest, 65'507U);
  }
}

TEST(WriteContents, PacketsOfMoreThanADatagramAreCutToOne) {
  model::Scenario scenario = paper(2, 1, 2);
  scenario.dds.spdp.payload_bytes = model::Bytes{1'000'000};
  scenario.dds.descriptors.user_bytes = model::Bytes{100'000};
  scenario.dds.sedp.heartbeat_bytes = model::Bytes{70'001};
  const SimulatedCapture capture = simulated_capture(scenario);
  const Conversation conversation = conversation_in(capture);
  EXPECT_EQ(difference(scenario, capture.run, conversation), "");
  EXPECT_EQ(conversation.datagrams.front().payload_bytes, 65'507U);
}

/// A bitmap of RTPS has 256 bits.
TEST(WriteContents, AnAcknackAsksForAtMost256Numbers) {
  const SimulatedCapture capture = simulated_capture(paper(2, 1, 800));
  std::uint32_t most = 0;
  for (const Event& event : conversation_in(capture).events) {
    if (event.acknack() != nullptr) most = std::max(most, event.acknack()->missing.size());
  }
  EXPECT_EQ(most, 256U);
}

TEST(WriteContents, HostsAreNumberedByAddressHoweverManyThereAre) {
  model::Deployment deployment;
  for (std::uint32_t host = 0; host < 300; ++host) {
    deployment.participants.emplace_back().host = model::HostId{2 * host};
  }
  const auto all = write::identities(deployment, fastdds_vendor);
  for (std::size_t k = 1; k < all.size(); ++k) {
    EXPECT_LT(all[k - 1].metatraffic.address, all[k].metatraffic.address);
    EXPECT_LT(all[k - 1].prefix, all[k].prefix);
  }
  EXPECT_EQ(to_string(all[299].user), "10.1.43.1:7411");
  EXPECT_EQ(all[299].name, "simulated_h598_p0");
}

}  // namespace write_contents_test
}  // namespace stormproof::capture::testing
