// What conformance says about the composition is what the composition says: every sender that it
// names is one effect there, every effect that a capture can show has a sender, and the guide names
// the same rules.
#include "checker/evidence/conform/report/effect_coverage.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/conform/senders.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/composition_of.hpp"
#include "tests/checker/evidence/conform/report/results.hpp"

namespace stormproof::conform {

namespace effect_coverage_test {

using namespace testing;
using fsm::composition::CompositionInfo;
using fsm::composition::EffectInfo;
using fsm::composition::RuleInfo;
using Names = std::set<std::string>;

std::set<Sender> all_senders(const model::DdsProfile& dds = fastdds()) {
  std::set<Sender> all;
  for (std::size_t k = 0; k < rule_count; ++k) {
    if (!is_rule_of(static_cast<Rule>(k), dds)) continue;
    const auto senders = senders_of(static_cast<Rule>(k));
    all.insert(senders.begin(), senders.end());
  }
  return all;
}

/// A capture in which each of them has sent one event.
Conformance sent_by(const std::set<Sender>& senders) {
  Conformance result;
  for (const Sender& sender : senders) result.by_sender[sender] = 1;
  result.explained = senders.size();
  return result;
}

model::DdsProfile resending(model::SpdpResend resend) {
  model::DdsProfile dds = fastdds();
  dds.spdp.resend = resend;
  return dds;
}

constexpr model::SpdpResend all_resends[] = {model::SpdpResend::all_known,
                                             model::SpdpResend::new_and_multicast,
                                             model::SpdpResend::new_only, model::SpdpResend::none};

TEST(EffectCoverage, EverySenderIsOneEffectAndEveryEffectHasASender) {
  for (const model::SpdpResend resend : all_resends) {
    const model::DdsProfile dds = resending(resend);
    std::set<Sender> senders = all_senders();
    // Who does not resend has no rule for it.
    const bool multicasts =
        resend == model::SpdpResend::all_known || resend == model::SpdpResend::new_and_multicast;
    if (!multicasts) senders.erase(sends::resent);
    if (resend == model::SpdpResend::none) senders.erase(sends::copies_resent);
    const CompositionCoverage coverage =
        effect_coverage(sent_by(senders), dds, tables::impossible_effects(dds));
    EXPECT_EQ(coverage.unattributed, 0U) << static_cast<int>(resend);
    EXPECT_EQ(coverage.seen(), coverage.possible()) << static_cast<int>(resend);
    EXPECT_EQ(coverage.rules_seen(), coverage.rules_possible());
    for (const RuleCoverage& rule : coverage.rules) {
      for (const EffectCoverage& one : rule.effects) {
        EXPECT_NE(one.times == 0, one.ruled_out_by.empty()) << one.effect->id;
      }
    }
  }
}

/// Of what a server adds, and of the rules of Fast DDS for descriptors on their way to it.
TEST(EffectCoverage, TheSameWithAServer) {
  for (const auto discovery : {model::Discovery::server, model::Discovery::super_client}) {
    for (const auto known : {model::ServerKnown::guid, model::ServerKnown::locator}) {
      model::DdsProfile dds = fastdds();
      dds.discovery = discovery;
      dds.server.known = known;
      std::set<Sender> senders = all_senders(dds);
      // A client begins to talk either at its first announcement or when it meets the server.
      const auto others =
          known == model::ServerKnown::guid
              ? std::set{sends::server::heartbeat_to_server_met, sends::server::own}
              : std::set{sends::server::announces_first, sends::server::first_heartbeat};
      for (const Sender& other : others) EXPECT_EQ(senders.erase(other), 1U);
      const CompositionCoverage coverage =
          effect_coverage(sent_by(senders), dds, tables::impossible_effects(dds));
      EXPECT_EQ(coverage.unattributed, 0U);
      EXPECT_EQ(coverage.seen(), coverage.possible());
      EXPECT_EQ(coverage.rules_seen(), coverage.rules_possible());
      for (const RuleCoverage& rule : coverage.rules) {
        for (const EffectCoverage& one : rule.effects) {
          EXPECT_NE(one.times == 0, one.ruled_out_by.empty()) << one.effect->id;
        }
      }
    }
  }
}

TEST(EffectCoverage, ReasonsAreKnobsOfTheProfile) {
  std::map<std::string, std::string> reasons;
  const auto impossible = tables::impossible_effects(fastdds());
  const CompositionCoverage coverage = effect_coverage({}, fastdds(), impossible);
  for (const RuleCoverage& rule : coverage.rules) {
    for (const EffectCoverage& one : rule.effects) reasons[one.effect->id] = one.ruled_out_by;
  }
  EXPECT_EQ(reasons.at("CycleGoesOn.8"), "sedp.heartbeat_policy: periodic");
  EXPECT_EQ(reasons.at("Hear.6"), "spdp.resend: all_known");
  EXPECT_EQ(reasons.at("AckNackArrives.3"), "");
}

TEST(EffectCoverage, WhatSeveralEffectsCanHaveSentCountsForNone) {
  const Conformance result = sent_by({sends::resent, sends::opening});
  // Nobody has said that one of Hear's two is ruled out.
  CompositionCoverage coverage = effect_coverage(result, fastdds(), {});
  EXPECT_EQ(coverage.seen(), 1U);
  EXPECT_EQ(coverage.unattributed, 1U);
  coverage = effect_coverage(result, fastdds(), tables::impossible_effects(fastdds()));
  EXPECT_EQ(coverage.seen(), 2U);
  EXPECT_EQ(coverage.unattributed, 0U);
  // Nor is what nobody can have sent forgotten.
  EXPECT_EQ(effect_coverage(sent_by({{"NoSuchRule", "Data"}}), fastdds(), {}).unattributed, 1U);
}

/// What is unobservable sends nothing, or belongs to control-only relations: nothing is left out.
TEST(EffectCoverage, AllEffectsOfAllRulesAreThere) {
  for (const auto kind : {model::ImplementationKind::fastdds, model::ImplementationKind::paper}) {
    model::DdsProfile dds;
    dds.implementation = kind;
    const CompositionInfo& composition = model::composition_of(dds);
    const CompositionCoverage coverage = effect_coverage({}, dds, {});
    Names seen(coverage.unobservable.begin(), coverage.unobservable.end());
    for (const RuleCoverage& rule : coverage.rules) {
      for (const EffectCoverage& one : rule.effects) seen.insert(one.effect->id);
    }
    Names all;
    for (const auto* list : {&composition.rules, &composition.procedures}) {
      for (const RuleInfo& rule : *list) {
        for (const EffectInfo& effect : rule.effects) {
          all.insert(effect.id);
          const bool user = effect.target.starts_with("User");
          const auto packets = packets_sent_by(composition, effect);
          if (effect.kind == "perform") continue;
          EXPECT_EQ(packets.empty(), user || effect.kind != "emit") << effect.id;
        }
      }
    }
    EXPECT_EQ(seen, all);
    EXPECT_EQ(coverage.observable() + coverage.unobservable.size(), all.size());
    EXPECT_EQ(coverage.rules.size() + coverage.unobservable_rules.size(),
              composition.rules.size() + composition.procedures.size());
  }
}

/// The table of rules in specs/guide/conforming.md.
TEST(EffectCoverage, TheGuideNamesTheSameSenders) {
  std::ifstream page{STORMPROOF_SPECS_DIR "/guide/conforming.md"};
  std::map<std::string, Names> named;
  const std::regex row{"\\| `([a-z_]+\\.[a-z_]+)` \\|.*\\|([^|]*)\\|"};
  const std::regex id{"§([A-Za-z ]+)"};
  for (std::string line; std::getline(page, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    const std::string by = match[2];
    for (std::sregex_iterator at{by.begin(), by.end(), id}; at != std::sregex_iterator{}; ++at) {
      named[match[1]].insert((*at)[1]);
    }
  }
  for (std::size_t k = 0; k < rule_count; ++k) {
    const auto rule = static_cast<Rule>(k);
    Names expected;
    for (const Sender& sender : senders_of(rule)) expected.insert(std::string{sender.scope});
    EXPECT_EQ(named[std::string{name_of(rule)}], expected) << name_of(rule);
  }
}

TEST_F(Reports, SayWhichRulesWereSeen) {
  good.by_sender[sends::reply] = 2;
  good.by_sender[sends::requested] = 3;
  good.by_rule[static_cast<std::size_t>(Rule::heartbeat_same_host)] = 2;
  Report report = report_of(good);
  report.impossible = tables::impossible_effects(dds);
  const auto coverage = to_json(report)["composition_coverage"];
  EXPECT_EQ(coverage["composition"], "fastdds");
  EXPECT_EQ(coverage["rule_coverage"]["seen"], 2);
  EXPECT_EQ(coverage["effect_coverage"]["seen"], 2);
  EXPECT_EQ(coverage["unattributed"], 2);
  std::size_t uncovered = 0;
  for (const auto& effect : coverage["effect_coverage"]["observable"]) {
    if (effect["times"] == 0 && effect["ruled_out_by"].is_null()) ++uncovered;
  }
  EXPECT_EQ(uncovered, coverage["effect_coverage"]["possible"].get<std::size_t>() - 2);
  const std::string page = report::to_html(document_of(report));
  EXPECT_TRUE(has(page, "Rules of the composition: 2 seen sending of 9"));
  EXPECT_TRUE(has(page, "AckNackArrives.3: emit Heartbeat"));
  EXPECT_TRUE(has(page, "because of spdp.resend: all_known"));
  EXPECT_TRUE(has(page, "2 events are put down to what the capture does not show"));
  EXPECT_TRUE(has(report::to_text(document_of(report), {.verbose = true}), "Deliver ToRequesters"));
  EXPECT_TRUE(has(report::to_text(document_of(report)), "with -v: "));
}

}  // namespace effect_coverage_test
}  // namespace stormproof::conform
