// Backlog and source queue of one participant: what fits, what is admitted alone, and how copies
// are counted.
#include "model/engine/source_queue.hpp"

#include <gtest/gtest.h>

namespace stormproof::model {
namespace source_queue_test {

const Fragmentation fragmentation{WirelessProfile{}};

Packet packet(std::uint32_t payload_bytes, std::uint32_t copies = 1) {
  Packet p;
  p.payload_bytes = payload_bytes;
  p.copies = copies;
  return p;
}

TEST(SourceQueue, APacketThatExactlyFillsTheQueueFits) {
  SourceQueue queue;
  queue.push(packet(1'472), fragmentation);
  queue.push(packet(42), fragmentation);  // 42 + 8 + 58 = 108
  EXPECT_EQ(queue.head_demand(), 1'538);
  EXPECT_EQ(queue.fitting(Bytes{1}), 1U);
  queue.admit_head(fragmentation);
  EXPECT_EQ(queue.head_demand(), 108);
  EXPECT_EQ(queue.fitting(Bytes{1'538 + 108}), 1U);
  EXPECT_EQ(queue.fitting(Bytes{1'538 + 107}), 0U);
}

TEST(SourceQueue, APacketLargerThanTheQueueIsAdmittedAlone) {
  SourceQueue queue;
  queue.push(packet(5'000), fragmentation);
  queue.push(packet(1), fragmentation);
  EXPECT_EQ(queue.fitting(Bytes{100}), 1U);
  const std::int64_t demand = queue.head_demand();
  queue.admit_head(fragmentation);
  EXPECT_EQ(queue.admitted_bytes(), demand);
  EXPECT_EQ(queue.fitting(Bytes{100}), 0U);
  queue.release(demand);
  EXPECT_EQ(queue.admitted_bytes(), 0);
  EXPECT_EQ(queue.fitting(Bytes{100}), 1U);
}

TEST(SourceQueue, AnUnlimitedQueueTakesEverything) {
  SourceQueue queue;
  for (int k = 0; k < 100; ++k) queue.push(packet(65'000), fragmentation);
  while (queue.fitting(WirelessProfile::unlimited) > 0) queue.admit_head(fragmentation);
  EXPECT_EQ(queue.backlog_packets(), 0U);
  EXPECT_EQ(queue.fitting(WirelessProfile::unlimited), 0U);
}

TEST(SourceQueue, EveryCopyOfARecordIsAdmittedForItself) {
  SourceQueue queue;
  queue.push(packet(68, 3), fragmentation);  // 134 bytes each
  queue.push(packet(1'473), fragmentation);
  EXPECT_EQ(queue.backlog_packets(), 4U);
  EXPECT_EQ(queue.head_fragments(), 1);
  EXPECT_EQ(queue.fitting(Bytes{1'000}), 3U);
  EXPECT_EQ(queue.fitting(Bytes{300}), 2U);
  queue.admit_head(fragmentation);
  EXPECT_EQ(queue.fitting(Bytes{300}), 1U);
  queue.admit_head(fragmentation);
  EXPECT_EQ(queue.admitted_bytes(), 268);
  EXPECT_EQ(queue.fitting(Bytes{300}), 0U);
  EXPECT_EQ(queue.backlog_packets(), 2U);
  queue.release(134);
  queue.admit_head(fragmentation);
  EXPECT_EQ(queue.head_fragments(), 2);
  EXPECT_EQ(queue.backlog_packets(), 1U);
}

TEST(SourceQueue, CopiesOfARecordThatFitAreAdmittedTogether) {
  SourceQueue queue;
  queue.push(packet(68, 5), fragmentation);  // 134 bytes each
  queue.push(packet(90), fragmentation);
  queue.admit_head(fragmentation, 4);
  EXPECT_EQ(queue.admitted_bytes(), 536);
  EXPECT_EQ(queue.backlog_packets(), 2U);
  queue.admit_head(fragmentation);
  EXPECT_EQ(queue.head_demand(), 156);
  EXPECT_EQ(queue.fitting(Bytes{1'000}), 1U);
}

TEST(SourceQueue, ThePeakIsWhatDidNotFit) {
  SourceQueue queue;
  queue.push(packet(68, 5), fragmentation);
  queue.admit_head(fragmentation);
  queue.note_peak(Nanoseconds{10});
  queue.admit_head(fragmentation);
  queue.note_peak(Nanoseconds{20});
  const BacklogPeak peak = queue.peak();
  EXPECT_EQ(peak.packets, 4U);
  EXPECT_EQ(peak.at, Nanoseconds{10});
  EXPECT_EQ(peak.packets_at_end, 3U);
}

TEST(SourceQueue, WhatIsAdmittedIsTakenInTheOrderInWhichItCame) {
  SourceQueue queue;
  Packet first = packet(68, 3);
  first.number = 7;
  first.pair = 4;
  queue.push(std::move(first), fragmentation);
  Packet second = packet(90);
  second.number = 10;
  queue.push(std::move(second), fragmentation);
  while (queue.fitting(WirelessProfile::unlimited) > 0) queue.admit_head(fragmentation);
  const auto every_second_pair = [](const Packet&, std::uint32_t pair) { return pair + 2; };
  for (std::uint32_t k = 0; k < 4; ++k) {
    Packet taken;
    queue.take(taken, every_second_pair);
    EXPECT_EQ(taken.number, 7U + k);
    EXPECT_EQ(taken.copies, 1U);
    EXPECT_EQ(taken.pair, k < 3 ? 4 + 2 * k : 0);
    EXPECT_EQ(taken.payload_bytes, k < 3 ? 68U : 90U);
  }
}

}  // namespace source_queue_test
}  // namespace stormproof::model
