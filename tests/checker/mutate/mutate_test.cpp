// Every check can fail: at least 95 % of the mutants are noticed, every property notices at least
// one, and survivors say why.
#include "checker/mutate/mutate.hpp"

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
