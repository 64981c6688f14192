// What is written on a tape is read from it as it was, whatever it is, and by readers that go on at
// their own pace.
#include "model/engine/packet_tape.hpp"

#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/engine/submessage.hpp"

namespace stormproof::model {
namespace packet_tape_test {

std::vector<std::uint32_t> members(const DescriptorSet& set) {
  std::vector<std::uint32_t> list;
  set.for_each([&](std::uint32_t d) { list.push_back(d); });
  return list;
}

/// All that a packet says, as words.
std::vector<std::uint64_t> words_of(const Packet& p) {
  std::vector<std::uint64_t> words{p.number,
                                   static_cast<std::uint64_t>(p.emitted.count()),
                                   p.pair,
                                   p.payload_bytes,
                                   p.copies,
                                   p.rank_limit,
                                   p.detail,
                                   static_cast<std::uint64_t>(p.kind),
                                   static_cast<std::uint64_t>(p.stream),
                                   p.from_repair,
                                   p.carries_initial,
                                   p.carries_heartbeat,
                                   p.heartbeats,
                                   p.initial_acknack,
                                   p.to_group,
                                   p.to_nobody,
                                   static_cast<std::uint64_t>(p.use),
                                   p.port,
                                   p.initial_data,
                                   p.repair_data,
                                   p.submessages == nullptr ? 0 : p.submessages->size()};
  for (const std::uint32_t d : members(p.descriptors)) words.push_back(d);
  return words;
}

/// Small numbers are as likely as large ones.
std::uint32_t number() {
  return *rc::gen::oneOf(rc::gen::inRange<std::uint32_t>(0, 4),
                         rc::gen::arbitrary<std::uint32_t>());
}

Packet any_packet(std::uint64_t n, std::int64_t now) {
  const auto flag = [] { return *rc::gen::arbitrary<bool>(); };
  Packet p;
  p.number = n;
  p.emitted = Nanoseconds{now};
  p.kind = static_cast<PacketKind>(*rc::gen::inRange<int>(0, packet_kind_count));
  p.stream = flag() ? Stream::sub : Stream::pub;
  p.pair = number();
  p.payload_bytes = number();
  p.copies = number();
  p.rank_limit = number();
  p.detail = number();
  p.from_repair = flag();
  p.carries_initial = flag();
  p.carries_heartbeat = flag();
  p.heartbeats = static_cast<std::uint16_t>(number());
  p.initial_acknack = flag();
  p.to_group = flag();
  p.to_nobody = flag();
  p.use = static_cast<TrafficClass>(*rc::gen::inRange<int>(0, traffic_class_count));
  p.port = static_cast<std::uint8_t>(number());
  p.initial_data = number();
  p.repair_data = number();
  const auto words = *rc::gen::inRange<std::uint32_t>(0, 4);
  for (std::uint32_t k = *rc::gen::inRange<std::uint32_t>(0, 600), end = k + words; k < end; ++k) {
    p.descriptors.add(
        k, flag() ? std::uint64_t{1} << (number() % 64) : *rc::gen::arbitrary<std::uint64_t>());
  }
  if (*rc::gen::inRange(0, 8) == 0) {
    p.submessages = std::make_shared<std::vector<Submessage>>(1 + number() % 3);
  }
  return p;
}

RC_GTEST_PROP(PacketTape, SaysWhatWasWritten, ()) {
  PacketTape tape;
  PacketTape::Reader sizes;
  PacketTape::Reader all;
  std::deque<std::vector<std::uint64_t>> unread;
  std::deque<std::pair<std::uint32_t, std::uint32_t>> unskimmed;
  std::uint64_t n = 0;
  std::int64_t now = 0;
  const auto take = [&] {
    Packet packet;
    all.take(tape, packet);
    RC_ASSERT(words_of(packet) == unread.front());
    unread.pop_front();
  };
  const auto skim = [&] {
    const PacketTape::Reader::Size size = sizes.skim(tape);
    RC_ASSERT(std::pair(size.payload_bytes, size.copies) == unskimmed.front());
    unskimmed.pop_front();
  };
  const auto steps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 5));
  for (const int step : steps) {
    if (step < 3) {
      n += number();
      now += number();
      Packet packet = any_packet(n, now);
      unread.push_back(words_of(packet));
      unskimmed.emplace_back(packet.payload_bytes, packet.copies);
      tape.write(std::move(packet));
    } else if (!unskimmed.empty()) {
      skim();
    }
    // Nobody takes what has not been looked at.
    if (step == 4 && unread.size() > unskimmed.size()) take();
  }
  while (!unskimmed.empty()) skim();
  while (!unread.empty()) take();
}

TEST(PacketTape, GoesOnOverManyChunks) {
  PacketTape tape;
  PacketTape::Reader sizes;
  PacketTape::Reader all;
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    Packet packet;
    packet.number = k;
    packet.payload_bytes = k % 7;
    packet.kind = k % 2 == 0 ? PacketKind::data : PacketKind::heartbeat;
    packet.descriptors.add(k % 3, k);
    tape.write(std::move(packet));
  }
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    ASSERT_EQ(sizes.skim(tape).payload_bytes, k % 7);
    if (k < 100) continue;
    Packet packet;
    all.take(tape, packet);
    ASSERT_EQ(packet.number, k - 100);
    ASSERT_EQ(packet.descriptors.word((k - 100) % 3), k - 100);
  }
}

}  // namespace packet_tape_test
}  // namespace stormproof::model
