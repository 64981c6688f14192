// The specifications that are built into the program are those in the source tree, and the expected
// matrix gives reasons.
#include <set>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "checker/engines/tables/ignored_pairs.hpp"
#include "tests/files.hpp"

namespace stormproof::tables {
namespace specs_test {

std::string text_of(const std::string& name) {
  return files::content(STORMPROOF_SPECS_DIR "/" + name);
}

TEST(EmbeddedSpecs, AreTheFiles) {
  EXPECT_EQ(text_of("ignored-pairs.yaml"), ignored_pairs_text);
  EXPECT_EQ(text_of("expected/commutation.yaml"), expected_commutation_text);
}

TEST(ExpectedCommutation, EveryEntryGivesAReasonOnce) {
  const YAML::Node file = YAML::Load(expected_commutation_text);
  ASSERT_EQ(file["implementations"].size(), 2U);
  for (const auto& implementation : file["implementations"]) {
    std::set<std::set<std::string>> pairs;
    for (const auto& section : implementation.second) {
      const bool matters = section.first.as<std::string>() == "matters";
      for (const YAML::Node& entry : section.second) {
        const std::set<std::string> pair{entry["pair"][0].as<std::string>(),
                                         entry["pair"][1].as<std::string>()};
        EXPECT_TRUE(pairs.insert(pair).second) << *pair.begin();
        EXPECT_GE(entry["why"].as<std::string>().size(), 20U) << *pair.begin();
        EXPECT_EQ(entry["decided"].IsDefined(), matters) << *pair.begin();
      }
    }
  }
}

TEST(IgnoredPairs, AreReadPerMachine) {
  const IgnoredPairs pairs = ignored_pairs("SingleShot");
  EXPECT_EQ(pairs.no_row,
            (std::set<IgnoredPairs::Pair>{{"Idle", "Due"}, {"Pending", "Requested"}}));
  EXPECT_TRUE(pairs.guards_reject.empty());
  EXPECT_EQ(pairs.never_occur.size(), 1U);
  EXPECT_TRUE(ignored_pairs("Announcer").no_row.empty());
}

}  // namespace specs_test
}  // namespace stormproof::tables
