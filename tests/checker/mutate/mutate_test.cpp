// Every check can fail: at least 95 % of the mutants are noticed, every property notices at least
// one, and survivors say why.
#include "checker/mutate/mutate.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "props/property.hpp"

namespace stormproof::mutate {
namespace {

TEST(Mutants, HaveUniqueIdsDescriptionsAndMistakes) {
  std::set<std::string> ids;
  for (const CatalogueEntry& entry : mutants()) {
    const checker::Mutant& mutant = entry.mutant;
    EXPECT_TRUE(ids.insert(mutant.id).second) << mutant.id;
    EXPECT_FALSE(mutant.description.empty()) << mutant.id;
    const bool mistaken = !mutant.rules.tables.empty() || !mutant.rules.events.empty() ||
                          mutant.rules.live_bitmaps || mutant.knobs ||
                          mutant.order != checker::OrderRule::time_class_insertion;
    EXPECT_TRUE(mistaken) << mutant.id;
  }
  EXPECT_GE(ids.size(), 30U);
}

TEST(Mutants, CoverEveryMachine) {
  std::set<std::string> mutated;
  for (const CatalogueEntry& entry : mutants()) {
    for (const fsm::TableMutation& table : entry.mutant.rules.tables) mutated.insert(table.machine);
  }
  for (const char* machine :
       {"DescriptorRepair", "DiscoveryReader", "HeartbeatTimer", "InitialAckNack", "Announcer",
        "Channel", "ChangeForReader", "SingleShot", "ControlReader"}) {
    EXPECT_TRUE(mutated.contains(machine)) << machine;
  }
}

/// One mutant of each kind with a property that must notice it.
TEST(Mutate, EachKindOfMistakeIsNoticedByTheRightProperty) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"acknowledges-everything", "safety.ack-implies-received"},
      {"repairs-unasked", "safety.repair-only-if-asked"},
      {"live-bitmap", "safety.snapshot"},
      {"expiry-doubled", "timer.single-heartbeat"},
      {"queue-twice-as-large", "safety.conservation"},
      {"order-pairwise", "order.total"},
      {"base-ignored", "safety.ack-implies-received"}};
  MutateOptions options;
  for (const auto& [mutant, property] : cases) options.only.push_back(mutant);
  const MutationReport report = mutate(options);
  ASSERT_EQ(report.mutants.size(), cases.size());
  for (const auto& [mutant, property] : cases) {
    const auto found = std::find_if(report.mutants.begin(), report.mutants.end(),
                                    [&, id = mutant](const auto& each) { return each.id == id; });
    ASSERT_NE(found, report.mutants.end()) << mutant;
    EXPECT_EQ(std::count(found->killed_by.begin(), found->killed_by.end(), property), 1)
        << mutant << " is not noticed by " << property;
  }
}

TEST(Mutate, PropertiesNoticeTheMutants) {
  const MutationReport report = mutate({});
  for (const MutantResult& mutant : report.mutants) {
    EXPECT_TRUE(!mutant.killed_by.empty() || !mutant.reason.empty()) << mutant.id;
  }
  EXPECT_GE(100 * report.killed(), 95 * report.mutants.size());
  for (const props::Property& property : props::catalogue()) {
    EXPECT_GE(report.killed_by(property.id), 1U) << property.id << " notices no mutant";
  }
}

}  // namespace
}  // namespace stormproof::mutate
