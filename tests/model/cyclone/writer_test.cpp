// What a writer makes of ACKNACKs: what it repeats, for whom, and how it answers.
#include <gtest/gtest.h>

#include "tests/model/cyclone/bench.hpp"

namespace stormproof::model::cyclone {
namespace writer_test {

constexpr std::uint32_t pub = writer::publications;
constexpr std::uint32_t sub = writer::subscriptions;
using Words = std::vector<std::string>;

template <class... Submessages>
std::vector<Submessage> packet(Submessages... submessages) {
  std::vector<Submessage> list;
  (list.push_back(std::move(submessages)), ...);
  return list;
}

/// Participant 0 has created all its endpoints, then met the others; the time is 50 ms.
struct Writer : Bench {
  template <class Change>
  Writer(std::uint32_t peers, Change change) : Bench{peers} {
    change(scenario());
    start();
    run_to(0);
    for (std::uint32_t j = 1; j <= peers; ++j) introduce(0, j);
    run_to(50 * ms);
    (void)sent_by(0);
  }
  explicit Writer(std::uint32_t peers) : Writer{peers, [](Scenario&) {}} {}

  /// What it sends at this instant to whom.
  std::vector<std::pair<std::uint32_t, Words>> sends_now(std::int64_t time_ns) {
    run_to(time_ns);
    std::vector<std::pair<std::uint32_t, Words>> list;
    for (const Sent& sent : sent_by(0)) {
      if (sent.time_ns == time_ns) list.emplace_back(sent.to, sent.messages);
    }
    return list;
  }
};
using Sends = std::vector<std::pair<std::uint32_t, Words>>;

TEST(CycloneWriter, RepeatsAndAnswersWhoAsked) {
  Writer w{1};
  w.receive(1, 0, packet(request_for(0, pub, {2, 4}, 1)));
  EXPECT_EQ(w.sends_now(50 * ms), (Sends{{1, {"DATA 0:2", "DATA 0:4", "HEARTBEAT 0:9 directed"}}}));
}

TEST(CycloneWriter, OneAnswerForTwoRequestsOfARelationInAPacket) {
  Writer w{1};
  w.receive(1, 0, packet(request_for(0, pub, {2}, 1), request_for(0, pub, {3}, 2)));
  EXPECT_EQ(w.sends_now(50 * ms), (Sends{{1, {"DATA 0:2", "DATA 0:3", "HEARTBEAT 0:9 directed"}}}));
}

TEST(CycloneWriter, ASecondRelationInThePacketLetsTheFirstAnswerGo) {
  Writer w{1};
  w.receive(1, 0,
            packet(request_for(0, pub, {2}, 1), request_for(0, sub, {3}, 1),
                   request_for(0, pub, {5}, 2)));
  EXPECT_EQ(w.sends_now(50 * ms),
            (Sends{{1,
                    {"DATA 0:2", "DATA 1:3", "HEARTBEAT 0:9 directed", "DATA 0:5",
                     "HEARTBEAT 1:8 directed", "HEARTBEAT 0:9 directed"}}}));
}

TEST(CycloneWriter, AnOldCountIsHeardOnlyAfterHalfASecond) {
  Writer w{1};
  w.receive(1, 0, packet(request_for(0, pub, {2}, 7)));
  EXPECT_EQ(w.sends_now(50 * ms).size(), 1U);
  w.run_to(550 * ms - 1);
  (void)w.sent_by(0);
  w.receive(1, 0, packet(request_for(0, pub, {2}, 7)));
  EXPECT_EQ(w.sends_now(550 * ms - 1), Sends{});
  w.run_to(550 * ms);
  (void)w.sent_by(0);
  w.receive(1, 0, packet(request_for(0, pub, {2}, 3)));
  EXPECT_EQ(w.sends_now(550 * ms), (Sends{{1, {"DATA 0:2", "HEARTBEAT 0:9 directed"}}}));
}

TEST(CycloneWriter, StopsAtTheFirstRefusal) {
  Writer w{2, [](Scenario& s) { s.dds.sedp.max_queued_rexmit_messages = 2; }};
  w.receive(1, 0, packet(request_for(0, pub, {2, 4, 6, 8}, 1)));
  // 4 is found in the queue; 5 is refused, and 6 is not looked at.
  w.receive(2, 0, packet(request_for(0, pub, {4, 5, 6}, 1)));
  EXPECT_EQ(w.sends_now(50 * ms), (Sends{{1, {"DATA 0:2"}},
                                         {1, {"DATA 0:4"}},
                                         {2, {"DATA 0:4"}},
                                         {1, {"HEARTBEAT 0:9 directed"}},
                                         {2, {"HEARTBEAT 0:9 directed"}}}));
}

TEST(CycloneWriter, AllRefusedIsNotAnswered) {
  Writer w{1, [](Scenario& s) { s.dds.sedp.max_queued_rexmit_messages = 0; }};
  w.receive(1, 0, packet(request_for(0, pub, {2}, 1)));
  EXPECT_EQ(w.sends_now(50 * ms), Sends{});
}

TEST(CycloneWriter, AQueuedRepairGoesToTheSetOnce) {
  Writer w{3};
  w.receive(1, 0, packet(request_for(0, pub, {2}, 1)));
  w.receive(2, 0, packet(request_for(0, pub, {2}, 1)));
  w.receive(3, 0, packet(request_for(0, pub, {2}, 1)));
  EXPECT_EQ(w.sends_now(50 * ms), (Sends{{1, {"DATA 0:2"}},
                                         {2, {"DATA 0:2"}},
                                         {3, {"DATA 0:2"}},
                                         {1, {"HEARTBEAT 0:9 directed"}},
                                         {2, {"HEARTBEAT 0:9 directed"}},
                                         {3, {"HEARTBEAT 0:9 directed"}}}));
}

TEST(CycloneWriter, TheSetIsThatOfTheTimeOfTheMerge) {
  Bench w{3};
  w.start();
  w.run_to(0);
  w.introduce(0, 1);
  w.introduce(0, 2);
  w.run_to(50 * ms);
  (void)w.sent_by(0);
  w.receive(1, 0, packet(request_for(0, pub, {2}, 1)));
  w.receive(2, 0, packet(request_for(0, pub, {2}, 1)));
  w.introduce(0, 3);
  w.receive(3, 0, packet(request_for(0, pub, {2}, 1)));
  w.run_to(50 * ms);
  std::vector<std::uint32_t> receivers;
  for (const Sent& sent : w.sent_by(0)) {
    if (sent.messages.front() == "DATA 0:2") receivers.push_back(sent.to);
  }
  EXPECT_EQ(receivers, (std::vector<std::uint32_t>{1, 2}));
}

TEST(CycloneWriter, WithoutMergingEachReaderGetsItsOwn) {
  Writer w{2, [](Scenario& s) { s.dds.sedp.merge_queued_rexmit = MergeQueued::no; }};
  w.receive(1, 0, packet(request_for(0, pub, {2}, 1), request_for(0, pub, {2}, 2)));
  w.receive(2, 0, packet(request_for(0, pub, {2}, 1)));
  EXPECT_EQ(w.sends_now(50 * ms), (Sends{{1, {"DATA 0:2", "HEARTBEAT 0:9 directed"}},
                                         {2, {"DATA 0:2", "HEARTBEAT 0:9 directed"}}}));
}

TEST(CycloneWriter, RepeatsOnlyWhatHasBeenSent) {
  Bench w{1, 60 * ms};  // publications are created at 60, 180, 300 ms
  w.start();
  w.run_to(0);
  w.introduce(0, 1);
  w.run_to(180 * ms - 1);
  (void)w.sent_by(0);
  w.step();  // the creation; its DATA is in the queue
  w.receive(1, 0, packet(request_for(0, pub, {1, 2}, 1)));
  w.run_to(180 * ms);
  const std::vector<Sent> sent = w.sent_by(0);
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent.at(0).messages, Words{"DATA 0:2"});  // to the set
  EXPECT_EQ(sent.at(1).messages, (Words{"DATA 0:1", "HEARTBEAT 0:2 directed"}));
}

TEST(CycloneWriter, ACreationBeginsTheIntervalAnew) {
  // Of the 17 endpoints the publications come after 4, 12, 20 … s; nobody ever replies.
  Bench w{1, 4'000 * ms};
  w.start();
  w.run_to(0);
  w.introduce(0, 1);
  w.run_to(12'000 * ms - 1);
  (void)w.sent_by(0);
  w.run_to(13'000 * ms);
  std::vector<std::int64_t> times;
  for (const Sent& sent : w.sent_by(0)) {
    for (const std::string& message : sent.messages) {
      if (message.starts_with("HEARTBEAT 0:")) times.push_back(sent.time_ns / ms);
    }
  }
  // The interval had grown to seconds.
  ASSERT_GE(times.size(), 5U);
  for (std::size_t k = 1; k < 5; ++k) EXPECT_EQ(times.at(k) - times.at(k - 1), 100);
}

TEST(CycloneParticipant, AnnouncesItselfAtOnceSoonAndThenEveryEightSeconds) {
  Bench w{1};
  w.start();
  w.run_to(17'000 * ms);
  std::vector<std::int64_t> times;
  for (const Sent& sent : w.sent_by(0, /*all=*/true)) {
    EXPECT_EQ(sent.to, group);
    EXPECT_EQ(sent.messages, Words{"SPDP"});
    EXPECT_EQ(sent.bytes, 336);
    times.push_back(sent.time_ns);
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 100 * ms, 8'100 * ms, 16'100 * ms}));
}

TEST(CycloneParticipant, AnswersANewOneFourTimes) {
  Bench w{1};
  w.start();
  w.run_to(10 * ms);
  Submessage announcement = announcement_of(1);
  announcement.directed = false;
  w.receive(1, 0, packet(std::move(announcement)));
  w.run_to(7'000 * ms);
  std::vector<std::int64_t> times;
  for (const Sent& sent : w.sent_by(0, /*all=*/true)) {
    for (const std::string& message : sent.messages) {
      if (message == "SPDP directed") times.push_back(sent.time_ns);
    }
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{10 * ms, 1'010 * ms, 2'010 * ms, 3'010 * ms}));
}

}  // namespace writer_test
}  // namespace stormproof::model::cyclone
