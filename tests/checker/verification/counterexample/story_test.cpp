// What stories say and what they leave out.
#include "checker/verification/counterexample/story.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "checker/presentation/sequence/chart.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/verification/counterexample/acts.hpp"
#include "checker/verification/counterexample/selection.hpp"
#include "tests/checker/verification/counterexample/examples.hpp"

namespace stormproof::counterexample {
namespace story_test {

/// `text` in one line, so that it does not matter where lines break.
std::string flat(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool space = c == ' ' || c == '\n';
    if (!space)
      result += c;
    else if (!result.empty() && result.back() != ' ')
      result += ' ';
  }
  return result;
}

TEST(Story, OfTheSmallestDeployment) {
  const std::string text = story(smallest());
  EXPECT_EQ(text.rfind("storm.free-threshold is violated at event 101, 13.653072 ms\n", 0), 0U);
  EXPECT_NE(text.find("  run        2 participants on 2 hosts, each with 1 pub + 1 sub"),
            std::string::npos);
  EXPECT_NE(text.find("  timers     τ_H 1 s, τ_A 10 µs, τ_N 100 µs, τ_S 10 µs, τ_I 70 ms\n"),
            std::string::npos);
  EXPECT_EQ(text.substr(text.find("   event")),
            R"(   event              ms  participant: what it does; what changes
       0        0.000000  0: announcement; sends p0 SPDP 0→all [AnnouncementIsDue.3]
       …                  (6 events: 5 on the channel, 1 of SPDP)
       7        1.221350  1: receives p0 SPDP 0→all; 0→1 pub DiscoveryReader: Unknown→Recognised;
                          0→1 pub InitialAckNack: Dormant→Waiting; sends 2 other packets; initial
                          ACKNACK at 71.221350 ms [ReaderOpened.4] | 0: pub writer HeartbeatTimer:
                          Idle→Armed; sends p4 DATA 0→1 pub, 0–9 [WriterSideOpens.2]; sends p5
                          HEARTBEAT 0→1 pub [WriterSideOpens.4]; sends 2 other packets; HEARTBEAT
                          expiry at 1001.221350 ms [ClockGoesOn.2]
       …                  (35 events: 32 on the channel, 3 of SPDP)
      43        6.573343  1: receives p5 HEARTBEAT 0→1 pub; ACKNACK generation at 6.583343 ms
                          [TakeHeartbeat.3]
      45        6.583343  1: ACKNACK generation 0→1 pub; sends p14 ACKNACK 1→0 pub, lacks 0–9
                          [AckNackDue.2]
       …                  (53 events: 45 on the channel, 2 of SPDP, 6 of other relations)
      99       13.553072  0: receives p14 ACKNACK 1→0 pub, lacks 0–9; 0→1 pub 0–9: U→R; repair DATA
                          generation at 13.653072 ms [AckNackArrives.4]
!    101       13.653072  0: repair DATA generation 0→1 pub; 0→1 pub 0–9: R→Q; sends p18 repair
                          DATA+HEARTBEAT 0→1 pub, 0–9 [RepairIsDue.2]

The property breaks: At 13.653072 ms descriptor 0 of participant 0's pub stream at participant 1 is
                     generated again, though nothing was lost.
)");
}

TEST(Story, TellsLossAndItsRepair) {
  const std::string text = flat(story(lossy()));
  EXPECT_NE(text.find("net: p4 DATA 0→1 pub, 0–9 is lost"), std::string::npos) << text;
  EXPECT_NE(text.find("lost: p4"), std::string::npos) << text;
  EXPECT_NE(text.find("constant delay 30 µs"), std::string::npos) << text;
  EXPECT_NE(text.find("0→1 pub 0–9: U→R"), std::string::npos) << text;
}

TEST(Story, TellsWhichPacketsTakeLonger) {
  const std::string text = flat(story(delayed()));
  EXPECT_NE(text.find("constant delay 30 µs, except p4 30 ms"), std::string::npos) << text;
  EXPECT_NE(text.find("receives p4 DATA 0→1 pub, 0–9 (all known already)"), std::string::npos)
      << text;
}

TEST(Story, TellsFastDdsFromWhatHappensOnOneHost) {
  const std::string text = flat(story(fastdds()));
  EXPECT_NE(text.find("Fast DDS's writer"), std::string::npos);
  EXPECT_NE(text.find("receives HEARTBEAT 5→6 pub on its host"), std::string::npos) << text;
  EXPECT_NE(text.find("5→6 pub 0–7: R→Q"), std::string::npos) << text;
  EXPECT_EQ(text.find("participant 3's"), std::string::npos);
}

TEST(Story, OfAStormIsShortAndKeepsTheDecisiveEvents) {
  const std::string text = story(storm());
  EXPECT_LE(std::ranges::count(text, '\n'), 130);
  EXPECT_NE(flat(text).find("p8 DATA 0→2 pub, 0–12 (all new)"), std::string::npos) << text;
  EXPECT_NE(flat(text).find("p989 repair DATA 0→2 pub, 0–2 (all known already)"),
            std::string::npos);
  EXPECT_NE(text.find("0→2 pub 0–12: U→R"), std::string::npos);
  EXPECT_NE(text.find("like these"), std::string::npos);
}

TEST(Story, EndsWithTheReason) {
  for (const Example& example : examples()) {
    const std::string text = story(example.counterexample);
    const std::string end = flat(text.substr(text.rfind("The property breaks: ")));
    EXPECT_EQ(end, "The property breaks: " + example.counterexample.reason + " ") << example.name;
  }
}

TEST(Story, HasNoLongLines) {
  for (const Example& example : examples()) {
    for (const std::size_t columns : {80U, 100U}) {
      std::string text = story(example.counterexample, columns);
      while (!text.empty()) {
        const std::size_t end = text.find('\n');
        EXPECT_LE(report::columns(text.substr(0, end)), columns + 10) << text.substr(0, end);
        text.erase(0, end + 1);
      }
    }
  }
}

TEST(Story, OfAnEventThatNeverHappensIsStillAStory) {
  props::Counterexample late = smallest();
  late.event = 1'000'000;
  EXPECT_NE(story(late).find("storm.free-threshold is violated at event 1,000,000"),
            std::string::npos);
}

TEST(Story, ShowsTheEnginesOwnSteps) {
  props::Counterexample told = smallest();
  told.steps = {"The HEARTBEAT overtakes the DATA."};
  EXPECT_NE(story(told).find("  - The HEARTBEAT overtakes the DATA.\n"), std::string::npos);
}

/// The texts of an event's acts with their effects.
std::vector<std::string> told(const History& history, std::size_t step) {
  std::vector<std::string> texts;
  for (const Act& act : acts_of(history, step, relevance_of(history))) {
    texts.push_back(sequence::with_effect(act.text, act.effect));
  }
  return texts;
}

TEST(Acts, NameTheEffectsThatTheHistoryKnows) {
  History history = record(smallest());
  constexpr std::size_t sends_acknack = 45;
  const auto says = [&](const std::string& words) {
    const auto texts = told(history, sends_acknack);
    return std::ranges::any_of(texts, [&](const auto& text) { return text.ends_with(words); });
  };
  EXPECT_TRUE(says("sends p14 ACKNACK 1→0 pub, lacks 0–9 [AckNackDue.2]"));
  history.packets.at(14).effect.clear();
  EXPECT_TRUE(says("sends p14 ACKNACK 1→0 pub, lacks 0–9"));
}

TEST(Acts, OfDifferentEffectsAreToldApart) {
  History history = record(smallest());
  constexpr std::size_t sends = 45;
  const PacketLog acknack = history.packets.at(14);
  history.packets.emplace(1000, acknack);
  history.steps[sends].emitted.push_back(1000);
  Relevance relevance = relevance_of(history);
  relevance.packets.insert(1000);
  const auto count = [&] {
    const auto acts = acts_of(history, sends, relevance);
    return std::ranges::count(acts, Act::Kind::sent, &Act::kind);
  };
  EXPECT_EQ(count(), 1);
  history.packets.at(1000).effect = "InitialAckNackDue.3";
  EXPECT_EQ(count(), 2);
}

TEST(Relevance, IsTheConeAndTheRelation) {
  const History history = record(smallest());
  const Relevance relevance = relevance_of(history);
  ASSERT_EQ(history.steps.size(), 102U);
  EXPECT_EQ(relevance.relations, std::set<std::uint32_t>{0});
  std::vector<std::size_t> relevant;
  for (std::size_t n = 0; n < relevance.steps.size(); ++n) {
    if (relevance.steps[n]) relevant.push_back(n);
  }
  // Announcement, its reception, HEARTBEAT, ACKNACK sent, ACKNACK received, repair.
  EXPECT_EQ(relevant, (std::vector<std::size_t>{0, 7, 43, 45, 99, 101}));
  EXPECT_EQ(relevance.count, relevant.size());
  EXPECT_EQ(relevance.packets, (std::set<std::uint64_t>{0, 4, 5, 14, 18}));
}

TEST(Relevance, CausesComeBeforeTheirEffects) {
  for (const Example& example : examples()) {
    const History history = record(example.counterexample);
    const Relevance relevance = relevance_of(history);
    EXPECT_TRUE(relevance.steps.back()) << example.name;
    for (std::size_t n = 0; n < history.steps.size(); ++n) {
      if (relevance.essential[n]) {
        EXPECT_TRUE(relevance.steps[n]) << example.name << n;
      }
      if (history.steps[n].cause) {
        EXPECT_LT(*history.steps[n].cause, n);
      }
    }
  }
}

TEST(Selection, CoversEveryEventOnceAndKeepsTheLimit) {
  for (const Example& example : examples()) {
    const History history = record(example.counterexample);
    const Relevance relevance = relevance_of(history);
    for (const std::size_t limit : {4U, 10U, 40U, 1'000'000U}) {
      std::size_t next = 0;
      std::size_t shown = 0;
      for (const Selected& selected : select(history, relevance, limit)) {
        EXPECT_EQ(selected.step, next);
        next = selected.last + 1;
        if (!selected.gap) {
          ++shown;
          EXPECT_TRUE(relevance.steps[selected.step]);
        }
      }
      EXPECT_EQ(next, history.steps.size());
      EXPECT_EQ(shown, std::min(limit, relevance.count)) << example.name;
    }
  }
}

TEST(Words, TimesAndMembers) {
  EXPECT_EQ(report::milliseconds(model::Nanoseconds{13'653'072}), "13.653072");
  EXPECT_EQ(report::milliseconds(model::Nanoseconds{7}), "0.000007");
  const std::vector<std::uint64_t> words{0b1'0111, 1, 0};
  EXPECT_EQ(members_text(words), "0–2, 4, 64");
  const std::vector<std::uint64_t> crossing{std::uint64_t{1} << 63U, 1};
  EXPECT_EQ(members_text(crossing), "63–64");
  EXPECT_EQ(members_text({}), "");
}

}  // namespace story_test
}  // namespace stormproof::counterexample
