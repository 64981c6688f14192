// Every check can fail: at least 95 % of the mutants are noticed, every property notices the one
// that is named here, and survivors say why. Half of the mutants that a run can show are noticed by
// laws, too.
#include "checker/verification/mutate/mutate.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/document/render.hpp"
#include "checker/verification/mutate/law_trials.hpp"
#include "checker/verification/mutate/mutate_report.hpp"
#include "fsm/composition/composition_info.hpp"
#include "fsm/machines.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"
#include "props/property.hpp"

namespace stormproof::mutate {
namespace mutate_test {

using Pair = std::pair<std::string, std::string>;

TEST(Mutants, HaveUniqueIdsDescriptionsAndMistakes) {
  std::set<std::string> ids;
  for (const CatalogueEntry& entry : mutants()) {
    const checker::Mutant& mutant = entry.mutant;
    EXPECT_TRUE(ids.insert(mutant.id).second) << mutant.id;
    EXPECT_FALSE(mutant.description.empty()) << mutant.id;
    const bool mistaken = !mutant.rules.tables.empty() || !mutant.rules.events.empty() ||
                          mutant.rules.live_bitmaps || mutant.knobs ||
                          !mutant.rules.effects.empty() ||
                          mutant.order != checker::OrderRule::time_class_insertion;
    EXPECT_TRUE(mistaken) << mutant.id;
  }
  EXPECT_GE(ids.size(), 30U);
}

/// Whether only implementations have the machine that no profile names as such, so that no trial
/// could notice a mistake in it. The oracles notice those in its rows (tests/oracle).
bool is_of_unknown_writers(std::string_view machine) {
  const auto has_it = [&](model::ImplementationKind kind) {
    const auto& parts = model::composition_of(kind).parts;
    return std::ranges::any_of(parts, [&](const auto& part) { return part.machine == machine; });
  };
  bool has_some = false;
  for (std::size_t k = 0; k < model::implementation_traits.size(); ++k) {
    has_some = has_some || has_it(static_cast<model::ImplementationKind>(k));
  }
  return has_some && std::ranges::none_of(model::implementations, has_it);
}

TEST(Mutants, CoverEveryMachine) {
  std::set<std::string> mutated;
  for (const CatalogueEntry& entry : mutants()) {
    for (const fsm::TableMutation& table : entry.mutant.rules.tables) mutated.insert(table.machine);
  }
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    if (is_of_unknown_writers(machine.name)) continue;
    EXPECT_TRUE(mutated.contains(std::string{machine.name})) << machine.name;
  }
}

/// One mutant of each kind with a law that must notice it; and what laws cannot see. Of all that a
/// run can show they notice half.
TEST(LawTrials, MistakesAreNoticedByTheRightLaw) {
  const std::vector<Pair> cases{{"never-acknowledged", "law.silence"},
                                {"repair-a-nanosecond-late", "law.single-loss"},
                                {"acknack-not-sent", "law.answers"},
                                {"channel-idles", "law.work-conserving"},
                                {"announcements-end", "law.announcements"},
                                {"attempts-mistake-interval", "law.initial-attempts"},
                                {"base-ignored", "law.failure-free"},
                                {"order-pairwise", ""},
                                {"suppression-zero", ""}};
  LawTrials trials;
  std::size_t tried = 0;
  std::size_t noticed = 0;
  for (const CatalogueEntry& entry : mutants()) {
    if (entry.kind == Kind::effect) continue;
    const bool shows = shows_in_runs(entry.mutant);
    const std::vector<std::string> killers =
        shows ? trials.killers(entry) : std::vector<std::string>{};
    tried += shows ? 1U : 0U;
    noticed += killers.empty() ? 0U : 1U;
    const auto found = std::ranges::find(cases, entry.mutant.id, &Pair::first);
    if (found == cases.end()) continue;
    if (found->second.empty()) {
      EXPECT_TRUE(killers.empty()) << entry.mutant.id << " is noticed by " << killers.front();
    } else {
      EXPECT_EQ(std::count(killers.begin(), killers.end(), found->second), 1)
          << entry.mutant.id << " is not noticed by " << found->second;
    }
  }
  EXPECT_GE(tried, 80U);
  EXPECT_GE(2 * noticed, tried);
}

TEST(MutateReport, ShowsLawsBesideProperties) {
  MutationReport report;
  report.everybody = true;
  report.mutants.push_back(
      {"a", Kind::table, "first", {"timer.armed"}, "", {{"law.counts", "law.answers"}}});
  report.mutants.push_back(
      {"b", Kind::table, "second", {"timer.armed"}, "", std::vector<std::string>{}});
  report.mutants.push_back({"c", Kind::table, "third", {"order.total"}, "", std::nullopt});
  const std::string text = to_text(document_of(report));
  EXPECT_NE(text.find("property tests: law.counts, law.answers"), std::string::npos) << text;
  EXPECT_NE(text.find("property tests: none"), std::string::npos) << text;
  EXPECT_NE(text.find("property tests: – (no run shows it)"), std::string::npos) << text;
  EXPECT_NE(text.find("killed by property tests: 1 of the 2 that a run can show (50.0 %)"),
            std::string::npos)
      << text;
  const nlohmann::ordered_json json = to_json(report);
  EXPECT_EQ(json["mutants"][0]["killed_by_laws"].size(), 2U);
  EXPECT_EQ(json["mutants"][1]["killed_by_laws"].size(), 0U);
  EXPECT_TRUE(json["mutants"][2]["killed_by_laws"].is_null());
  EXPECT_EQ(json["killed_by_any_law"], 1);
  EXPECT_EQ(json["tried_on_laws"], 2);
  EXPECT_EQ(json["killed_by_law"]["law.counts"], 1);
}

/// Losses, late packets and late endpoints show what an undisturbed discovery never does: here that
/// an ACKNACK arms the HEARTBEAT timer of a writer that has no expiry pending.
TEST(Mutate, MistakesThatOnlyDisturbedRunsShowAreNoticed) {
  MutateOptions options;
  for (const char* effect : {"5", "6", "11", "12"}) {
    options.only.push_back(std::string{"fastdds:AckNackArrives."} + effect + ":dropped");
  }
  const MutationReport report = mutate(options);
  EXPECT_EQ(report.mutants.size(), 4U);
  EXPECT_EQ(report.unseen(), 0U);
  for (const MutantResult& mutant : report.mutants) {
    EXPECT_TRUE(mutant.noticed()) << mutant.id << ": " << mutant.reason;
  }
}

MutantResult of_effect(std::string id, std::vector<std::string> killed_by,
                       std::optional<Harm> harm = {}) {
  MutantResult result{std::move(id), Kind::effect, "wrong", std::move(killed_by), "", {}};
  result.harm = harm;
  return result;
}

/// Nobody has proved that it changes nothing, so nobody says so.
TEST(MutateReport, WhatNoRunShowsIsUnseen) {
  MutationReport report;
  report.mutants.push_back(of_effect("a", {}, Harm::unseen));
  report.mutants.back().reason = "no difference in 120 random runs";
  for (int k = 0; k < 18; ++k) report.mutants.push_back(of_effect("b", {"live.no-stall"}));
  EXPECT_EQ(report.unseen(), 1U);
  EXPECT_TRUE(report.notices_enough());
  const std::string text = to_text(document_of(report));
  EXPECT_NE(text.find("unseen: no difference in 120 random runs"), std::string::npos) << text;
  EXPECT_NE(text.find("18 of 18 mutants are noticed"), std::string::npos) << text;
  EXPECT_NE(text.find("1 more are unseen in 120 random runs"), std::string::npos) << text;
  EXPECT_EQ(text.find("harmless"), std::string::npos) << text;
}

/// Who executes the correct rules beside a run notices nothing if the rules are wrong: such mutants
/// are counted apart, and what they change is said of each.
TEST(MutateReport, WhatOnlyCorrectRulesNoticeIsCountedApart) {
  MutationReport report;
  for (int k = 0; k < 5; ++k) report.mutants.push_back(of_effect("paper:a", {"live.no-stall"}));
  for (int k = 0; k < 3; ++k) {
    report.mutants.push_back(of_effect("paper:b", {"composition.followed"}, Harm::messages));
  }
  EXPECT_EQ(report.killed(), 8U);
  EXPECT_EQ(report.only_followed(), 3U);
  EXPECT_EQ(report.noticed_in_rules(), 5U);
  EXPECT_EQ(report.seen_at_effects(), 8U);
  EXPECT_TRUE(report.notices_enough());
  const std::string text = to_text(document_of(report));
  EXPECT_NE(text.find("of 8 at effects 5 (62.5 %) if the rules themselves"), std::string::npos)
      << text;
  EXPECT_NE(text.find("random runs that differ are judged"), std::string::npos) << text;
  EXPECT_NE(text.find("paper:b: changes how many messages there are"), std::string::npos) << text;
  report.mutants.push_back(of_effect("paper:c", {"composition.followed"}, Harm::time));
  EXPECT_FALSE(report.notices_enough());  // 5 of 9 are fewer than 60 %
  report.mutants.push_back(of_effect("cyclone:c", {"composition.followed"}, Harm::time));
  EXPECT_EQ(report.shares().size(), 2U);
  EXPECT_FALSE(report.shares()[0].suffices());
  EXPECT_TRUE(report.shares()[1].suffices());  // laws and engines do not know its writer
  report.mutants.push_back({"d", Kind::event, "late", {"composition.followed"}, "", {}});
  EXPECT_EQ(report.seen_at_effects(), 10U);
}

/// Several hundred, one for each mistake that the rules allow. Those that nobody notices change
/// nothing in random runs, or have a reason.
TEST(Mutate, MistakesAtEffectsAreNoticed) {
  MutateOptions options;
  options.kinds = {Kind::effect};
  const MutationReport report = mutate(options);
  EXPECT_GE(report.mutants.size(), 900U);
  EXPECT_TRUE(report.notices_enough()) << report.killed() << " of " << report.mutants.size();
  for (const char* writer : {"paper:", "fastdds:"}) {
    std::size_t seen = 0;
    std::size_t noticed = 0;
    for (const MutantResult& mutant : report.mutants) {
      if (!mutant.id.starts_with(writer) || mutant.unseen()) continue;
      ++seen;
      noticed += mutant.noticed_in_rules() ? 1U : 0U;
    }
    EXPECT_GE(10 * noticed, 8 * seen) << writer << ' ' << noticed << " of " << seen;
  }
  for (const MutantResult& mutant : report.mutants) {
    EXPECT_TRUE(mutant.noticed() || !mutant.reason.empty()) << mutant.id;
    EXPECT_NE(mutant.reason, "no property and no law notices it") << mutant.id;
  }
}

/// For each property a mutant that it must notice, and some more.
const std::vector<Pair>& pairs() {
  static const std::vector<Pair> list{{"confirmation-inverted", "fsm.determinism"},
                                      {"control-writer-silent", "fsm.totality"},
                                      {"control-writer-closed", "fsm.reachability"},
                                      {"acknack-forgotten", "composition.total"},
                                      {"acknack-forgotten", "composition.live"},
                                      {"acknack-forgotten", "composition.pending"},
                                      {"repair-a-nanosecond-late", "composition.followed"},
                                      {"timer-moves-later", "composition.followed"},
                                      {"order-pairwise", "order.total"},
                                      {"dispatch-first", "order.reception-first"},
                                      {"repair-never-requested", "order.commutation"},
                                      {"acknowledges-everything", "safety.ack-implies-received"},
                                      {"base-ignored", "safety.ack-implies-received"},
                                      {"any-acknack-replies", "safety.ack-implies-received"},
                                      {"late-attempt-resets", "safety.ack-stable"},
                                      {"requests-unlisted", "safety.repair-only-if-asked"},
                                      {"live-bitmap", "safety.snapshot"},
                                      {"queue-twice-as-large", "safety.conservation"},
                                      {"expiry-doubled", "timer.single-heartbeat"},
                                      {"attempt-at-the-same-instant", "timer.progress"},
                                      {"suppression-zero", "timer.suppression-honoured"},
                                      {"confirmation-inverted", "live.no-stall"},
                                      {"repair-never-requested", "live.completion"},
                                      {"acknack-forgotten", "live.quiescence"},
                                      {"attempts-end-early", "live.recovery"},
                                      {"waits-for-the-dead", "live.isolation"},
                                      {"repair-never-requested", "storm.single-copy"},
                                      {"repair-never-requested", "storm.free-threshold"},
                                      {"attempts-at-once", "storm.cannot-start"},
                                      {"announces-to-all", "storm.join-cost"},
                                      {"charged-with-everything", "storm.piggyback-rate"},
                                      {"acknack-answered-at-once", "storm.feedback-gain"}};
  return list;
}

TEST(Mutate, EachPropertyHasAMutantThatItMustNotice) {
  for (const props::Property& property : props::catalogue()) {
    EXPECT_TRUE(std::ranges::any_of(pairs(), [&](const Pair& pair) {
      return pair.second == property.id;
    })) << property.id;
  }
}

const MutantResult& result_of(const MutationReport& report, const std::string& mutant) {
  const auto found = std::ranges::find(report.mutants, mutant, &MutantResult::id);
  EXPECT_NE(found, report.mutants.end()) << mutant;
  static const MutantResult none;
  return found == report.mutants.end() ? none : *found;
}

/// All are asked whether anybody notices them; those of the pairs and the survivors, who does. Who
/// notices first is one of these, and there is one exactly if anybody notices.
TEST(Mutate, PropertiesNoticeTheMutants) {
  MutateOptions options;
  options.kinds = {Kind::table, Kind::event, Kind::snapshot, Kind::knob, Kind::order};
  const MutationReport first = mutate(options);
  EXPECT_FALSE(first.everybody);
  for (const MutantResult& mutant : first.mutants) {
    EXPECT_TRUE(!mutant.killed_by.empty() || !mutant.reason.empty()) << mutant.id;
  }
  EXPECT_GE(100 * first.killed(), 95 * first.mutants.size());

  options.everybody = true;
  for (const auto& [mutant, property] : pairs()) options.only.push_back(mutant);
  for (const MutantResult& mutant : first.mutants) {
    if (!mutant.noticed()) options.only.push_back(mutant.id);
  }
  const MutationReport everybody = mutate(options);
  for (const auto& [mutant, property] : pairs()) {
    EXPECT_EQ(std::ranges::count(result_of(everybody, mutant).killed_by, property), 1)
        << mutant << " is not noticed by " << property;
  }
  for (const MutantResult& all : everybody.mutants) {
    const MutantResult& one = result_of(first, all.id);
    EXPECT_EQ(one.noticed(), all.noticed()) << all.id;
    for (const std::string& id : one.killed_by) {
      EXPECT_EQ(std::ranges::count(all.killed_by, id), 1) << all.id << " and " << id;
    }
  }
}

}  // namespace mutate_test
}  // namespace stormproof::mutate
