// Replays decide by the rules of the composition: what was chosen is confirmed only if they send
// just what was captured, and then.
#include <gtest/gtest.h>

#include "checker/evidence/conform/data_replay.hpp"
#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/reader_replay.hpp"

namespace stormproof::conform {
namespace replay_rules_test {

constexpr std::int64_t ms = 1'000'000;

/// One relation of two descriptors.
struct Scene {
  capture::Conversation conversation{};
  Dialogue dialogue{conversation};
  Relation relation{};
  model::DdsProfile dds{};
  Bounds bounds{};
  const Context context{dialogue, dds, bounds};
  Conformance result{};
  PlaceResult place{};
  Machines machines{};
  Ledger ledger{result, place, machines};

  Scene() {
    dds.implementation = model::ImplementationKind::fastdds;
    relation.place = {0, 1, capture::entity::publications_writer};
    dialogue.descriptors = {{2, 0, 0}, {}};
    dialogue.end_ns = 10'000 * ms;
  }
  [[nodiscard]] std::uint64_t explained(Rule rule) const {
    return result.by_rule[static_cast<std::size_t>(rule)];
  }
};

/// The reader hears of both descriptors and says which it lacks.
Scene replied(const std::vector<std::uint32_t>& missing, bool arrives) {
  Scene scene;
  scene.relation.sent = {{2 * ms, 0, 1, {}, Heartbeat{1, 2, 1, true, false}}};
  const Answer answer{20 * ms, 1, 0, missing, false};
  ReaderReplay replay{scene.context, scene.relation, scene.ledger};
  replay.open(ms);
  Choice choice{1, {}, 3 * ms};
  choice.arrivals.arrived = {arrives};
  if (arrives) choice.arrivals.heartbeat = 0;
  replay.reply(answer, choice);
  return scene;
}

TEST(ReplayRules, AReplyListsWhatIsKnownAndMissing) {
  const Scene right = replied({0, 1}, true);
  EXPECT_EQ(right.explained(Rule::acknack_reply), 1U);
  EXPECT_EQ(right.result.not_replayed, 0U);
  const Scene wrong = replied({0}, true);
  EXPECT_EQ(wrong.explained(Rule::acknack_reply), 0U);
  EXPECT_EQ(wrong.result.not_replayed, 1U);
}

TEST(ReplayRules, WithoutAHeartbeatThereIsNoReply) {
  EXPECT_EQ(replied({0, 1}, false).result.not_replayed, 1U);
}

/// Descriptor 0 is sent at these times; ACKNACKs that ask for it arrive at those.
void send(Scene& scene, const std::vector<std::int64_t>& times,
          const std::vector<std::int64_t>& requests, std::uint32_t existing) {
  std::vector<Transmission> transmissions;
  Plan plan;
  for (const std::int64_t time : requests) {
    scene.relation.answers.push_back({time, 0, 0, {0}, false});
    plan.arrivals.push_back({time, time, true});
  }
  for (const std::int64_t time : times) {
    transmissions.push_back({0, time, 0, time == times.front(), existing == 0});
    plan.request.emplace_back();
    plan.to_everybody.push_back(false);
  }
  const AnnouncedSince announced;
  const std::set<std::size_t> to_everybody;
  const WriterContext context{scene.context, announced, true, to_everybody, {}};
  DataReplay replay{context, scene.relation, transmissions, existing, scene.ledger};
  EXPECT_EQ(replay.run(plan, 0), nullptr);
}

Scene sent(const std::vector<std::int64_t>& times, const std::vector<std::int64_t>& requests,
           std::uint32_t existing = 2) {
  Scene scene;
  send(scene, times, requests, existing);
  return scene;
}

TEST(ReplayRules, WhatIsAskedForIsSent) {
  const Scene pulled = sent({20 * ms}, {10 * ms});
  EXPECT_EQ(pulled.explained(Rule::data_pull), 1U);
  EXPECT_EQ(pulled.result.not_replayed, 0U);
  EXPECT_EQ(sent({20 * ms}, {}).result.not_replayed, 1U);
}

TEST(ReplayRules, WhatIsCreatedLaterIsPushed) {
  const Scene pushed = sent({20 * ms}, {}, 0);
  EXPECT_EQ(pushed.explained(Rule::data_push), 1U);
  EXPECT_EQ(pushed.result.not_replayed, 0U);
}

/// A request that arrives while the descriptor is suppressed is not one.
TEST(ReplayRules, WhatIsSuppressedIsNotSentAgain) {
  Scene scene;
  const std::int64_t suppression = scene.dds.sedp.nack_suppression_duration.count();
  ASSERT_GT(suppression, 3);
  const std::int64_t first = 20 * ms;
  const Scene again = sent({first, first + suppression / 2}, {10 * ms, first + 1});
  EXPECT_EQ(again.explained(Rule::data_repair), 0U);
  EXPECT_EQ(again.result.not_replayed, 1U);
  const Scene later = sent({first, first + 2 * suppression}, {10 * ms, first + suppression + 1});
  EXPECT_EQ(later.explained(Rule::data_repair), 1U);
  EXPECT_EQ(later.result.not_replayed, 0U);
}

/// By a relay of the server, participant 0: what was there is asked for, what is new is sent.
Scene passed_on(const std::vector<std::int64_t>& times, const std::vector<std::int64_t>& requests,
                std::uint32_t existing) {
  Scene scene;
  scene.dds.discovery = model::Discovery::server;
  scene.dialogue.server = 0;
  send(scene, times, requests, existing);
  return scene;
}

TEST(ReplayRules, OfAServerSayWhatIsSentToAClient) {
  EXPECT_EQ(passed_on({20 * ms}, {10 * ms}, 1).explained(Rule::relay_data), 1U);
  EXPECT_EQ(passed_on({20 * ms}, {}, 1).result.not_replayed, 1U);
  EXPECT_EQ(passed_on({20 * ms}, {}, 0).explained(Rule::relay_data), 1U);
  const Scene again = passed_on({20 * ms, 40 * ms}, {30 * ms}, 0);
  EXPECT_EQ(again.explained(Rule::relay_repair), 1U);
  EXPECT_EQ(again.result.not_replayed, 0U);
  // Nobody asked, or while it was suppressed.
  EXPECT_EQ(passed_on({20 * ms, 40 * ms}, {}, 0).result.not_replayed, 1U);
  EXPECT_EQ(passed_on({20 * ms, 40 * ms}, {20 * ms + 1}, 0).result.not_replayed, 1U);
}

/// What a client has been told that it need not have it does not ask for.
TEST(ReplayRules, OfAClientSayWhatItAsksTheServerFor) {
  const auto asked = [](const std::vector<std::uint32_t>& missing, std::int64_t first,
                        std::vector<std::uint32_t> gap) {
    Scene scene;
    scene.dds.discovery = model::Discovery::server;
    scene.dialogue.server = 0;
    Submessage told{2 * ms, 0, 1, {}, {}, false, std::move(gap)};
    Submessage heartbeat{2 * ms, 1, 1, {}, Heartbeat{first, 4, 1, true, false}, false, {}};
    scene.relation.sent = {told, heartbeat};
    const Answer answer{20 * ms, 2, missing.empty() ? 4 : missing.front(), missing, false};
    ReaderReplay replay{scene.context, scene.relation, scene.ledger};
    replay.open(ms);
    Choice choice{2, {}, 3 * ms};
    choice.arrivals.arrived = {true, true};
    choice.arrivals.heartbeat = 1;
    replay.reply(answer, choice);
    return scene.explained(Rule::relay_acknack);
  };
  EXPECT_EQ(asked({0, 1, 2, 3}, 1, {}), 1U);
  EXPECT_EQ(asked({1, 2, 3}, 1, {0}), 1U);
  EXPECT_EQ(asked({1, 2, 3}, 2, {}), 1U);
  EXPECT_EQ(asked({0, 1, 2, 3}, 2, {}), 0U);
  EXPECT_EQ(asked({0, 1, 3}, 1, {0}), 0U);
  EXPECT_EQ(asked({}, 5, {}), 1U);
}

}  // namespace replay_rules_test
}  // namespace stormproof::conform
