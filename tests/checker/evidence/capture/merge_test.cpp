// Captures of two hosts: nothing counts twice, and nothing is lost.
#include "checker/evidence/capture/merge.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "checker/evidence/capture/counting.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace merge_test {

using namespace testing;

constexpr EntityId pub = entity::publications_writer;
constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();

/// One datagram of a run: who sends it, when, and what.
struct Sent {
  bool by_first = true;
  std::int64_t at = 0;
  Buffer frame{};
  bool is_lost = false;  ///< the receiver does not see it
};

std::vector<Sent> a_run() {
  const Route forth{at(1, 7410), at(2, 7410), 0};
  const Route back{at(2, 7410), at(1, 7410), 0};
  const auto frame = [](const Route& route, const Message& message) {
    return ethernet(ipv4(route, message.buffer()));
  };
  const Message one = Message{prefix(1)}.announcement({at(1, 7410)});
  const Message two = Message{prefix(2)}.announcement({at(2, 7410)});
  return {{true, 0, frame({at(1, 7410), multicast(), 0}, one)},
          // The same bytes again are another datagram.
          {true, 100, frame({at(1, 7410), multicast(), 0}, one)},
          {false, 110, frame({at(2, 7410), multicast(), 0}, two), true},
          {true, 200, frame(forth, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1))},
          {true, 300, frame(forth, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1)), true},
          {false, 400, frame(back, Message{prefix(2)}.to(prefix(1)).acknack(pub, 2, 0, 0, true))},
          {true, 500, frame(forth, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1))}};
}

/// What a host captures: what it sends and, if `both_ways`, what reaches it 50 µs later.
Buffer capture_of(bool first, bool both_ways) {
  PcapFile file;
  for (const Sent& sent : a_run()) {
    if (sent.by_first == first) {
      file.frame(sent.at, sent.frame);
    } else if (both_ways && !sent.is_lost) {
      file.frame(sent.at + 50, sent.frame);
    }
  }
  return file.buffer();
}

model::Counts counts_of(const std::vector<Buffer>& files) {
  return count(conversation_of(files), always).counts;
}

constexpr model::Counts expected{
    .initial_data = 1, .repair_data = 2, .acknack = 1, .spdp_multicast = 3};

TEST(Merge, SourceSideCapturesAddUp) {
  EXPECT_EQ(counts_of({capture_of(true, false), capture_of(false, false)}), expected);
}

TEST(Merge, WhatBothHostsSawCountsOnce) {
  EXPECT_EQ(counts_of({capture_of(true, true), capture_of(false, true)}), expected);
  EXPECT_EQ(counts_of({capture_of(false, true), capture_of(true, true)}), expected);
  EXPECT_EQ(counts_of({capture_of(true, true), capture_of(false, false)}), expected);
}

TEST(Merge, TimesAreThoseOfTheSource) {
  const Conversation conversation =
      conversation_of({capture_of(false, true), capture_of(true, true)});
  std::vector<std::int64_t> times;
  for (const Event& event : conversation.events) times.push_back(event.time_ns);
  const std::vector<std::int64_t> wanted{time_of(0),   time_of(100), time_of(110), time_of(200),
                                         time_of(300), time_of(400), time_of(500)};
  EXPECT_EQ(times, wanted);
  EXPECT_EQ(conversation.captures[0].merged, 4U);
  EXPECT_EQ(conversation.captures[1].merged, 1U);
}

TEST(Merge, OneCaptureAloneIsTakenAsItIs) {
  const Conversation conversation = conversation_of({capture_of(true, true)});
  EXPECT_EQ(conversation.datagrams.size(), 6U);
  EXPECT_EQ(conversation.captures[0].merged, 0U);
}

TEST(Merge, AnotherPayloadPortOrIdentificationIsAnotherDatagram) {
  const Sighting one{0, 0, at(1, 1), at(2, 2), 7, 100, 5};
  std::vector<Sighting> sightings(5, one);
  sightings[4].capture = 1;
  sightings[1].digest = 6;
  sightings[2].destination.port = 3;
  sightings[3].ip_id = 8;
  EXPECT_EQ(merge(sightings), (std::vector<bool>{true, true, true, true, false}));
}

}  // namespace merge_test
}  // namespace stormproof::capture
