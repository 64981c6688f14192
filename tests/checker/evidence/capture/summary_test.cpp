// The reports: the names that scripts rely on, and what people are told first.
#include "checker/evidence/capture/summary.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/capture/timeline.hpp"
#include "checker/presentation/document/render.hpp"
#include "tests/checker/evidence/capture/packets.hpp"

namespace stormproof::capture {

namespace summary_test {

using namespace testing;

constexpr EntityId pub = entity::publications_writer;
constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();

Conversation a_conversation() {
  PcapFile file;
  file.message(0, {at(1, 7410), multicast()}, Message{prefix(1)}.announcement({at(1, 7410)}));
  file.message(9, {at(2, 7410), multicast()}, Message{prefix(2)}.announcement({at(2, 7410)}));
  const Route route{at(1, 7410), at(2, 7410)};
  file.message(20, route, Message{prefix(1)}.to(prefix(2)).descriptor(pub, 1).descriptor(pub, 2));
  file.message(99, route, Message{prefix(1)}.to(prefix(2)).heartbeat(pub, 1, 2, 1));
  return conversation_of({file.buffer()});
}

TEST(Summary, JsonHasTheNamesOfTheSimulator) {
  const Conversation conversation = a_conversation();
  const Counting counting = count(conversation, always);
  const auto json = to_json({conversation, counting});
  for (const auto& [name, value] : counting.counts.entries()) {
    EXPECT_EQ(json.at("counts").at(name), value);
  }
  EXPECT_EQ(json.at("counts").at("total"), 5);
  EXPECT_EQ(json.at("counts").at("initial_data"), 2);
  EXPECT_EQ(json.at("data_per_datagram").at("2"), 1);
  EXPECT_EQ(json.at("missing").at("count"), 0);
  EXPECT_EQ(json.at("missing").at("required"), 2);
  EXPECT_EQ(json.at("topology").at("participants").size(), 2U);
  EXPECT_EQ(json.at("topology").at("participants")[0].at("publications"), 2);
  EXPECT_EQ(json.at("heartbeats").at("relation_open"), 1);
  EXPECT_EQ(json.at("last_initial_data_ns"), time_of(20));
}

TEST(Summary, JsonReplacesNamesThatAreNoUtf8) {
  Conversation conversation = a_conversation();
  conversation.topology.participants[0].name = "\xff\xfe";
  const Counting counting = count(conversation, always);
  const auto json = to_json({conversation, counting});
  EXPECT_EQ(json.at("topology").at("participants")[0].at("name"), "\uFFFD\uFFFD");
  const std::string text = to_text(document_of({conversation, counting}));
  EXPECT_EQ(text.find('\xff'), std::string::npos);
}

TEST(Summary, TextSaysWhetherEveryDescriptorIsThere) {
  const Conversation conversation = a_conversation();
  const Counting whole = count(conversation, always);
  EXPECT_NE(
      to_text(document_of({conversation, whole})).find("Every required descriptor key is there"),
      std::string::npos);
  Counting lacking = whole;
  lacking.missing.push_back({prefix(1), prefix(2), pub, 3});
  lacking.missing_count = 1;
  lacking.last_initial_ns.reset();
  const std::string text = to_text(document_of({conversation, lacking}));
  EXPECT_NE(text.find("MISSING: 1 of 2"), std::string::npos);
  EXPECT_NE(text.find("pub 3 of participant 0 to participant 1"), std::string::npos);
}

TEST(Summary, TheTimelineHasEveryMessageOnce) {
  const Conversation conversation = a_conversation();
  const Counting counting = count(conversation, always);
  for (const std::size_t steps : {1U, 3U, 7U, 1000U}) {
    const Timeline line = timeline(conversation, counting, conversation.last_ns, steps);
    std::uint64_t total = 0;
    for (const auto& step : line.steps) {
      for (const std::uint64_t value : step) total += value;
    }
    EXPECT_EQ(total, counting.counts.total());
    EXPECT_LE(line.steps.size(), steps);
  }
  const Timeline halves = timeline(conversation, counting, conversation.last_ns, 2);
  ASSERT_EQ(halves.steps.size(), 2U);
  EXPECT_EQ(halves.steps[0][static_cast<std::size_t>(MessageClass::initial_data)], 2U);
  EXPECT_EQ(halves.steps[1][static_cast<std::size_t>(MessageClass::heartbeat)], 1U);
}

TEST(Summary, ThePlotHasALineForEachClass) {
  const Conversation conversation = a_conversation();
  const Counting counting = count(conversation, always);
  const std::string svg = to_svg({conversation, counting});
  for (std::size_t one = 0; one < message_class_count; ++one) {
    EXPECT_NE(svg.find(words_of(static_cast<MessageClass>(one))), std::string::npos);
  }
  EXPECT_NE(svg.find("every descriptor sent"), std::string::npos);
}

}  // namespace summary_test
}  // namespace stormproof::capture
