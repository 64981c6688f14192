// Queues of a channel of units that drop frames, on cases worked out by hand: what finds room,
// whose limit it is, and what the longest flow loses.
#include <vector>

#include <gtest/gtest.h>

#include "model/engine/unit_channel.hpp"

namespace stormproof::model {
namespace dropping_queue_test {

WirelessProfile with_queue(const QueueManagement& queue) {
  WirelessProfile wireless;
  wireless.service = ServedBy::unit;
  wireless.fragment_request = FragmentRequest::at_admission;
  wireless.aggregation.max_frames = 2;
  wireless.queue = queue;
  if (queue.discipline == QueueDiscipline::fq_codel) wireless.queueing = Queueing::flows;
  return wireless;
}

using Numbers = std::vector<std::uint64_t>;

/// Two hosts and an access point; frames are numbered from 0 on.
struct Bed {
  explicit Bed(const QueueManagement& queue) : channel{with_queue(queue), 2} {}

  void up(std::uint32_t host, std::int64_t bytes, std::uint32_t port = 0) {
    channel.request_uplink(host, frame(bytes), {false, host, 1 - host, port});
  }
  void down(std::uint32_t host, std::int64_t bytes, std::uint32_t port = 0) {
    channel.request_downlink(host, frame(bytes), {false, 1 - host, host, port});
  }
  Frame frame(std::int64_t bytes) { return {next++, 0, 0, bytes, {}}; }
  /// Those that were dropped since the last call.
  Numbers dropped() {
    Numbers numbers;
    while (const auto one = channel.next_dropped()) numbers.push_back(one->frame.number);
    return numbers;
  }

  UnitChannel channel;
  std::uint64_t next = 0;
};

TEST(TailDrop, WhatFindsNoRoomIsDropped) {
  Bed bed{{QueueDiscipline::tail_drop, QueuesOf::everybody, 2, {}}};
  for (int k = 0; k < 3; ++k) bed.up(0, 100);
  EXPECT_EQ(bed.dropped(), Numbers{2});
  bed.up(1, 100);  // another station has room of its own
  EXPECT_EQ(bed.dropped(), Numbers{});
  EXPECT_EQ(bed.channel.take({}).frames.size(), 2U);
  bed.up(0, 100);
  EXPECT_EQ(bed.dropped(), Numbers{});
  EXPECT_EQ(bed.channel.size(), 2U);
}

TEST(TailDrop, TheLimitIsOfAllQueuesOfTheAccessPoint) {
  Bed bed{{QueueDiscipline::tail_drop, QueuesOf::access_points, {}, Bytes{1'600}}};
  bed.down(0, 800);
  bed.down(1, 700);
  bed.down(Flow::everybody, 101);  // one byte too many
  EXPECT_EQ(bed.dropped(), Numbers{2});
  bed.down(Flow::everybody, 100);
  EXPECT_EQ(bed.dropped(), Numbers{});
  for (int k = 0; k < 20; ++k) bed.up(0, 1'500);  // stations have no limit
  EXPECT_EQ(bed.dropped(), Numbers{});
}

TEST(FqCodel, TheLongestFlowLosesHalfOfItsFramesFromItsHead) {
  Bed bed{{QueueDiscipline::fq_codel, QueuesOf::everybody, 6, {}}};
  for (int k = 0; k < 3; ++k) bed.up(0, 500);     // 1,500 bytes
  for (int k = 0; k < 3; ++k) bed.up(0, 100, 1);  // more frames, soon
  EXPECT_EQ(bed.dropped(), Numbers{});
  bed.up(0, 100, 1);
  EXPECT_EQ(bed.dropped(), (Numbers{0, 1}));  // 2 of 3: half, rounded up
  EXPECT_EQ(bed.channel.size(), 5U);
}

TEST(FqCodel, OfEquallyLongFlowsTheOneWithTheOldestHeadLoses) {
  Bed bed{{QueueDiscipline::fq_codel, QueuesOf::everybody, 1, {}}};
  bed.down(1, 300);
  bed.down(0, 300);
  EXPECT_EQ(bed.dropped(), Numbers{0});
}

TEST(FqCodel, AtMost64AreDroppedAtOnce) {
  Bed bed{{QueueDiscipline::fq_codel, QueuesOf::everybody, 200, {}}};
  for (int k = 0; k < 201; ++k) bed.up(0, 100);
  EXPECT_EQ(bed.dropped().size(), 64U);
}

TEST(FqCodel, EachFlowIsMeasuredAlone) {
  Bed bed{{QueueDiscipline::fq_codel,
           QueuesOf::everybody,
           {},
           {},
           Nanoseconds{5'000'000},
           Nanoseconds{100'000'000}}};
  for (int k = 0; k < 9; ++k) bed.up(0, 1'000);
  for (int k = 0; k < 2; ++k) bed.up(0, 1'000, 1);
  EXPECT_EQ(bed.channel.take(Nanoseconds{5'000'000}).frames.front().number, 0U);
  EXPECT_EQ(bed.dropped(), Numbers{});
  while (!bed.channel.empty()) static_cast<void>(bed.channel.take(Nanoseconds{105'000'000}));
  EXPECT_EQ(bed.dropped().size(), 1U);  // of the long one; the other has a full frame at most
}

}  // namespace dropping_queue_test
}  // namespace stormproof::model
