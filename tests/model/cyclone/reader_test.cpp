// What a reader makes of HEARTBEATs and DATA that come in another order than usual.
#include <gtest/gtest.h>

#include "tests/model/cyclone/bench.hpp"

namespace stormproof::model::cyclone {
namespace reader_test {

constexpr std::uint32_t pub = writer::publications;

template <class... Submessages>
std::vector<Submessage> packet(Submessages... submessages) {
  std::vector<Submessage> list;
  (list.push_back(std::move(submessages)), ...);
  return list;
}

/// Participant 1 knows participant 0, and the time is 20 ms.
struct Reader : Bench {
  explicit Reader(std::uint32_t publications = 0) : Bench{1, ms * 1'000, publications} {
    start();
    run_to(0);
    receive(0, 1, packet(announcement_of(0)));
    run_to(20 * ms);
    (void)sent_by(1);
  }
  /// What it has said about the publications since the last question.
  std::vector<Sent> acknacks() {
    std::vector<Sent> list = sent_by(1);
    std::erase_if(
        list, [](const Sent& sent) { return !sent.messages.front().starts_with("ACKNACK 0:"); });
    return list;
  }
  /// What it answers at once to this HEARTBEAT.
  std::vector<std::string> answers(std::int64_t time_ns, Submessage heartbeat) {
    run_to(time_ns);
    (void)sent_by(1);
    receive(0, 1, packet(std::move(heartbeat)));
    run_to(time_ns);
    return said();
  }
  std::vector<std::string> said() {
    std::vector<std::string> words;
    for (const Sent& sent : acknacks()) {
      words.insert(words.end(), sent.messages.begin(), sent.messages.end());
    }
    return words;
  }
};
using Words = std::vector<std::string>;

TEST(CycloneReader, ANewGapIsAskedForOnce) {
  Reader r;
  EXPECT_EQ(r.answers(30 * ms, heartbeat_of(0, pub, 2, 1)), (Words{"ACKNACK 0:1 1 2"}));
  EXPECT_EQ(r.answers(40 * ms, heartbeat_of(0, pub, 2, 2)), Words{});
  EXPECT_EQ(r.answers(41 * ms, heartbeat_of(0, pub, 3, 3)), Words{});  // 1 has been asked for
  r.run_to(130 * ms);
  EXPECT_EQ(r.said(), (Words{"ACKNACK 0:1 1 2 3"}));
}

TEST(CycloneReader, AnOldCountIsHeardOnlyAfterHalfASecond) {
  Reader r;
  EXPECT_EQ(r.answers(30 * ms, heartbeat_of(0, pub, 2, 5)), (Words{"ACKNACK 0:1 1 2"}));
  EXPECT_EQ(r.answers(500 * ms, heartbeat_of(0, pub, 3, 5)), Words{});
  EXPECT_EQ(r.answers(530 * ms - 1, heartbeat_of(0, pub, 4, 4)), Words{});
  EXPECT_EQ(r.answers(530 * ms, heartbeat_of(0, pub, 2, 4)), (Words{"ACKNACK 0:1 1 2 3 4"}));
}

TEST(CycloneReader, AStaleHeartbeatForItAloneDoesNotUrgeIt) {
  Reader r;
  EXPECT_EQ(r.answers(30 * ms, heartbeat_of(0, pub, 2, 5)), (Words{"ACKNACK 0:1 1 2"}));
  EXPECT_EQ(r.answers(31 * ms, heartbeat_of(0, pub, 2, 5, true)), Words{});
  EXPECT_EQ(r.answers(32 * ms, heartbeat_of(0, pub, 2, 6)), Words{});
  EXPECT_EQ(r.answers(33 * ms, heartbeat_of(0, pub, 2, 7, true)), (Words{"ACKNACK 0:1 1 2"}));
}

TEST(CycloneReader, DataTellsOfWhatExistsAndSchedulesNothing) {
  Reader r;
  EXPECT_EQ(r.answers(30 * ms, heartbeat_of(0, pub, 1, 1)), (Words{"ACKNACK 0:1 1"}));
  r.run_to(40 * ms);
  r.receive(0, 1, packet(data_of(0, pub, 3)));
  r.run_to(50 * ms);
  EXPECT_EQ(r.said(), Words{});
  EXPECT_EQ(r.answers(140 * ms, heartbeat_of(0, pub, 1, 2)), (Words{"ACKNACK 0:1 1 2"}));
}

TEST(CycloneReader, DataBeforeAnyHeartbeatIsDropped) {
  Reader r;
  r.receive(0, 1, packet(data_of(0, pub, 1)));
  EXPECT_EQ(r.answers(30 * ms, heartbeat_of(0, pub, 1, 1)), (Words{"ACKNACK 0:1 1"}));
}

TEST(CycloneReader, ABitmapTakesFourBytesForThirtyTwoSamples) {
  for (const auto& [samples, bytes] : {std::pair{31U, 4}, {32U, 4}, {33U, 8}}) {
    Reader r{40};
    r.run_to(30 * ms);
    r.receive(0, 1, packet(heartbeat_of(0, pub, samples, 1)));
    r.run_to(30 * ms);
    const std::vector<Sent> sent = r.acknacks();
    ASSERT_EQ(sent.size(), 1U);
    EXPECT_EQ(sent.front().bytes, 20 + 16 + 28 + bytes) << samples;
  }
}

TEST(CycloneReader, TheBitmapEndsAtTheLastSampleThatExists) {
  Reader r{40};
  (void)r.answers(30 * ms, heartbeat_of(0, pub, 1, 1));
  r.receive(0, 1, packet(data_of(0, pub, 33)));
  r.run_to(130 * ms);
  (void)r.sent_by(1);
  r.receive(0, 1, packet(heartbeat_of(0, pub, 1, 2)));
  r.run_to(130 * ms);
  const std::vector<Sent> sent = r.acknacks();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent.front().bytes, 20 + 16 + 28 + 8);  // 1 … 33, though 33 is there
}

TEST(CycloneReader, AsksAgainByItselfAfterThreeSeconds) {
  Reader r;
  EXPECT_EQ(r.answers(30 * ms, heartbeat_of(0, pub, 1, 1)), (Words{"ACKNACK 0:1 1"}));
  r.run_to(3'030 * ms - 1);
  EXPECT_EQ(r.said(), Words{});
  r.run_to(3'030 * ms);
  EXPECT_EQ(r.said(), (Words{"ACKNACK 0:1 1"}));
}

}  // namespace reader_test
}  // namespace stormproof::model::cyclone
