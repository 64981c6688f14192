// Packets handed to the protocol by hand, for what no run can produce: an initial ACKNACK that
// comes after an ordinary one. A reader sends none once it has seen a HEARTBEAT, and packets
// between two participants keep their order, but in a real network they need not.
#include "model/fastdds/protocol.hpp"

#include <gtest/gtest.h>

#include "tests/model/fastdds/one_writer.hpp"

namespace stormproof::model::fastdds {
namespace protocol_test {

constexpr std::uint32_t pub_writer_of_0 = 0;
constexpr std::uint32_t descriptors = 9;

/// Participant 0 has all its endpoints and has recognised 1; nothing else has happened.
class FastddsProtocol : public testing::Test, private Probe {
 protected:
  FastddsProtocol()
      : run_{scenario_, this, nullptr, SameHostPairs::included},
        network_{run_},
        protocol_{run_, network_} {
    network_.attach(protocol_);
    for (std::uint32_t k = 0; k < 17; ++k) handle(EventKind::endpoint_creation, 0, k);
    Packet announcement;
    announcement.kind = PacketKind::spdp_multicast;
    announcement.pair = 1;
    protocol_.received(announcement, 0);
  }

  void handle(EventKind kind, std::uint32_t subject, std::uint32_t detail = 0) {
    Event event;
    event.kind = kind;
    event.subject = subject;
    event.detail = detail;
    protocol_.handle(event);
  }

  void receive_acknack(bool initial, std::uint32_t base, std::uint64_t bitmap) {
    Packet packet;
    packet.kind = PacketKind::acknack;
    packet.pair = run_.topology.pair_between(0, 1);
    packet.initial_acknack = initial;
    packet.detail = base;
    packet.descriptors = DescriptorSet{Words{&bitmap, 1}};
    protocol_.received(packet, 0);
  }

  /// How many HEARTBEATs an expiry of the timer sends.
  std::uint64_t heartbeats_of_expiry() {
    const std::uint64_t before = run_.counts.heartbeat;
    handle(EventKind::heartbeat_expiry, pub_writer_of_0);
    return run_.counts.heartbeat - before;
  }

  void transition(const Transition& fired) override {
    std::uint64_t bits = fired.descriptors;
    if (fired.machine.machine == "ChangeForReader" && fired.event == "InitialAckNackReceived") {
      taken_back_ |= bits;
      taken_back_properly_ = fired.before == "A" && fired.after == "U";
    }
  }

  Scenario scenario_ = one_writer();
  RunState run_;
  Network network_;
  Protocol protocol_;
  std::uint64_t taken_back_ = 0;
  bool taken_back_properly_ = false;
};

TEST_F(FastddsProtocol, NothingAcknowledgedIsAReasonForAHeartbeatAndEverythingIsNone) {
  EXPECT_EQ(heartbeats_of_expiry(), 1U);
  receive_acknack(false, descriptors, 0);
  EXPECT_EQ(heartbeats_of_expiry(), 0U);
}

TEST_F(FastddsProtocol, ALateInitialAckNackTakesAcknowledgmentsBack) {
  receive_acknack(false, descriptors, 0);
  EXPECT_EQ(heartbeats_of_expiry(), 0U);  // the timer rests
  const std::uint64_t before = run_.counts.heartbeat;
  receive_acknack(true, 0, 0);
  EXPECT_EQ(run_.counts.heartbeat, before + 1);
  EXPECT_EQ(taken_back_, (1U << descriptors) - 1);
  EXPECT_TRUE(taken_back_properly_);
  EXPECT_EQ(heartbeats_of_expiry(), 1U);  // it was armed, and there is a reason
}

TEST_F(FastddsProtocol, ALateInitialAckNackForgetsTheMarkToo) {
  receive_acknack(false, descriptors, 0);
  receive_acknack(true, 0, 0);
  receive_acknack(false, 0, (1U << descriptors) - 1);  // requested: none is in U any more
  EXPECT_EQ(heartbeats_of_expiry(), 1U);               // but nothing is acknowledged
}

TEST_F(FastddsProtocol, RequestedDescriptorsAboveTheMarkAreNoReasonForAHeartbeat) {
  receive_acknack(false, 3, 0x1f8);
  EXPECT_EQ(heartbeats_of_expiry(), 0U);
}

TEST_F(FastddsProtocol, AnOlderAckNackDoesNotLowerTheMark) {
  receive_acknack(false, 3, 0);
  receive_acknack(false, 0, 0x1ff);  // 3 … 8 are requested; 0 … 2 stay acknowledged
  EXPECT_EQ(heartbeats_of_expiry(), 0U);
}

}  // namespace protocol_test
}  // namespace stormproof::model::fastdds
