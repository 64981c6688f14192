// Nothing in a composition is forgotten. What the check of completeness notices is shown on
// compositions from which something was taken away.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fsm/composition/compositions.hpp"

namespace stormproof::fsm::composition {
namespace composition_test {

std::string lines(const std::vector<Forgotten>& forgotten) {
  std::string text;
  for (const Forgotten& one : forgotten) text += one.what + "\n";
  return text;
}

const std::vector<CompositionInfo>& all() {
  static const std::vector<CompositionInfo> compositions = composition::compositions();
  return compositions;
}
CompositionInfo paper() { return all()[0]; }
CompositionInfo fastdds() { return all()[1]; }

RuleInfo& rule(CompositionInfo& composition, std::string_view id) {
  return *std::ranges::find(composition.rules, id, &RuleInfo::id);
}
void drop(RuleInfo& rule, std::string_view kind, std::string_view target) {
  std::erase_if(rule.effects, [&](const EffectInfo& effect) {
    return effect.kind == kind && effect.target == target;
  });
}

TEST(Composition, ForgetsNothing) {
  for (const CompositionInfo& composition : all()) {
    EXPECT_EQ(lines(what_is_forgotten(composition)), "") << composition.name;
  }
}

TEST(Composition, HasADifferentIdForEachEffect) {
  for (const CompositionInfo& composition : all()) {
    std::set<std::string> ids;
    for (const auto* rules : {&composition.rules, &composition.procedures, &composition.steps}) {
      for (const RuleInfo& rule : *rules) {
        for (const EffectInfo& effect : rule.effects) {
          EXPECT_TRUE(ids.insert(effect.id).second) << effect.id;
          EXPECT_TRUE(effect.file.find("fsm/composition/") != std::string_view::npos) << effect.id;
          EXPECT_GT(effect.line, 0U) << effect.id;
        }
      }
    }
    EXPECT_GT(ids.size(), 50U);
  }
}

/// What a step does is said by its contract. Of these it is not yet; the list can only get shorter.
const std::map<std::string, std::string>& empty_contracts() {
  static const std::map<std::string, std::string> steps{
      {"RefillBudget", "bytes of packets are the host's alone"},
      {"RefillLookupBudget", "bytes of packets are the host's alone"},
      {"Flush ToAll", "what is sent is said where it joins the message"},
      {"Flush ToRequesters", "what is sent is said where it joins the message"},
      {"LetAnswerGo", "the queue of messages is no thing of the rules"},
      {"JoinList AckTimer", "the list of timers is no thing of the rules"},
      {"JoinList HeartbeatTimer", "the list of timers is no thing of the rules"},
      {"JoinList SpdpTimer", "the list of timers is no thing of the rules"},
      {"JoinList ReplyTimer", "the list of timers is no thing of the rules"},
      {"JoinList LivelinessTimer", "the list of timers is no thing of the rules"},
      {"JoinList AddressTimer", "the list of timers is no thing of the rules"},
      {"LeaveList", "the list of timers is no thing of the rules"},
      {"LoseTimers", "the list of timers is no thing of the rules"},
      {"CompletePacket", "the packet that is filled is no thing of the rules"},
      {"KeepAddress", "addresses of announcements are the host's alone"},
      {"LetAddressAge", "addresses of announcements are the host's alone"},
      {"DropAddress", "addresses of announcements are the host's alone"},
      {"JoinParticipants", "what waits for the routine is no thing of the rules"},
      {"OpenReaders", "the rules of the server's readers are another composition's"},
      {"OpenOwnWriter", "the rules of a client's writers are another composition's"},
      {"OpenBuiltinSides", "the rules of control-only relations are another composition's"},
      {"JoinGoodbyes", "what waits for the routine is no thing of the rules"},
      {"ForgetRelayed", "what a client has received is no thing of the rules"},
      {"TakeNew", "what a client has learned is about pairs that the rules do not name"},
      {"TakeRelayed", "what a client has learned is about pairs that the rules do not name"},
  };
  return steps;
}
std::set<std::string> with_an_empty_contract(const std::vector<CompositionInfo>& compositions) {
  std::set<std::string> steps;
  for (const CompositionInfo& composition : compositions) {
    for (const RuleInfo& step : composition.steps) {
      if (step.effects.empty()) steps.insert(step.id);
    }
  }
  return steps;
}

TEST(Composition, HasNoEmptyContractButThoseThatAreListed) {
  std::set<std::string> listed;
  for (const auto& [step, reason] : empty_contracts()) listed.insert(step);
  EXPECT_EQ(with_an_empty_contract(all()), listed);
}

TEST(Completeness, NoticesAContractThatIsEmptied) {
  std::vector<CompositionInfo> compositions = all();
  std::vector<RuleInfo>& steps = compositions[0].steps;
  std::ranges::find(steps, "Generate", &RuleInfo::id)->effects.clear();
  EXPECT_TRUE(with_an_empty_contract(compositions).contains("Generate"));
}

TEST(Completeness, NoticesAnOutboxFieldThatNothingReads) {
  CompositionInfo composition = paper();
  std::erase(composition.consumed, "C.requested");
  EXPECT_EQ(lines(what_is_forgotten(composition)), "nothing reads C.requested\n");
  composition = fastdds();
  std::erase_if(composition.unused,
                [](const UnusedInfo& unused) { return unused.name != "SuppressionEnded"; });
  EXPECT_EQ(lines(what_is_forgotten(composition)),
            "nothing reads ControlWriterSide.start_initial\n"
            "nothing reads ControlWriterSide.reply\n"
            "nothing reads ControlReaderSide.send_heartbeat\n");
}

TEST(Completeness, NoticesAnEventThatNothingFeeds) {
  CompositionInfo composition = fastdds();
  drop(rule(composition, "NackResponds"), "feed each", "C");
  EXPECT_EQ(lines(what_is_forgotten(composition)), "nothing feeds C.NackResponseDue\n");
}

TEST(Completeness, NoticesATimerWithoutBeginningOrEnd) {
  CompositionInfo composition = paper();
  drop(rule(composition, "AckNackArrives"), "after", "RepairGeneration");
  EXPECT_EQ(lines(what_is_forgotten(composition)),
            "timer RepairGeneration is started by nothing\n");
  composition = paper();
  rule(composition, "SuppressionEnds").cause = "RepairGeneration";
  EXPECT_EQ(lines(what_is_forgotten(composition)), "timer SuppressionEnd is handled by no rule\n");
  composition = paper();
  std::erase_if(composition.timers, [](const ThingInfo& t) { return t.name == "SuppressionEnd"; });
  EXPECT_EQ(lines(what_is_forgotten(composition)),
            "SuppressionEnd is no timer of the composition\n");
}

TEST(Completeness, NoticesAPacketWithoutSenderOrReceiver) {
  CompositionInfo composition = fastdds();
  rule(composition, "ControlHeartbeatArrives").cause = "UserAckNack";
  EXPECT_EQ(lines(what_is_forgotten(composition)), "packet UserHeartbeat is received by nobody\n");
  composition = fastdds();
  for (const char* step : {"Pack ToAll", "Pack ToRequesters"}) {
    drop(*std::ranges::find(composition.steps, step, &RuleInfo::id), "emit", "Data");
  }
  EXPECT_EQ(lines(what_is_forgotten(composition)), "packet Data is emitted by nobody\n");
}

TEST(Completeness, NoticesAnOccasionWithoutRuleAndStateThatStaysAsItIs) {
  CompositionInfo composition = fastdds();
  rule(composition, "DescriptorIsCreated").cause = "WriterOpens";
  EXPECT_EQ(lines(what_is_forgotten(composition)), "occasion Created has no rule\n");
  composition = paper();
  drop(*std::ranges::find(composition.procedures, "Hear", &RuleInfo::id), "raise", "ReaderOpens");
  EXPECT_EQ(lines(what_is_forgotten(composition)), "occasion ReaderOpens is raised by nothing\n");
  composition = paper();
  drop(rule(composition, "DataArrives"), "set each", "X");
  EXPECT_EQ(lines(what_is_forgotten(composition)), "state X is set by nothing\n");
}

TEST(Completeness, NoticesAReasonThatIsNotNeededOrIsNone) {
  CompositionInfo composition = paper();
  composition.unused.push_back({"Reader", "opened", "it is read"});
  EXPECT_EQ(lines(what_is_forgotten(composition)), "Reader.opened is used, and needs no reason\n");
  composition = fastdds();
  composition.unused.front().reason = "";
  EXPECT_EQ(lines(what_is_forgotten(composition)),
            "nothing feeds HeartbeatClock.SuppressionEnded\n");
}

TEST(Completeness, WantsAReasonForWhatComesFromOutsideAndForNothingElse) {
  CompositionInfo composition = fastdds();
  composition.from_outside.clear();
  EXPECT_EQ(lines(what_is_forgotten(composition)),
            "timer Announcement is started by nothing but itself\n"
            "occasion Created is raised by nothing\n");
  composition = paper();
  composition.from_outside.push_back({"ReaderOpens", "it is raised"});
  EXPECT_EQ(lines(what_is_forgotten(composition)),
            "ReaderOpens is caused by a rule, and needs no reason\n");
}

TEST(Completeness, SaysWhereOneLooksAndWhatIsExpected) {
  CompositionInfo composition = paper();
  std::erase(composition.consumed, "C.requested");
  const Forgotten field = what_is_forgotten(composition).at(0);
  EXPECT_EQ(field.where.substr(0, field.where.find(':')),
            "AckNackArrives.3 at fsm/composition/paper.hpp");
  EXPECT_EQ(field.expected, "a condition or value with it, or a reason among what is unused");
  composition = paper();
  drop(rule(composition, "AckNackArrives"), "after", "RepairGeneration");
  EXPECT_EQ(what_is_forgotten(composition).at(0).where, "rule RepairIsDue");
}

TEST(Completeness, NoticesAPartThatIsNotListed) {
  CompositionInfo composition = paper();
  std::erase_if(composition.parts, [](const PartInfo& part) { return part.name == "Reader"; });
  EXPECT_NE(
      lines(what_is_forgotten(composition)).find("ReaderOpened.1 feeds Reader, which is no part\n"),
      std::string::npos);
}

}  // namespace composition_test
}  // namespace stormproof::fsm::composition
