// Totality: whatever a machine does not react to is listed in specs/ignored-pairs.yaml with a
// reason, and what is listed there is true. So no (state, event) pair of any table can be
// forgotten, and no entry can outlive the row that makes it wrong.
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {
namespace totality_test {

enum class Entry { no_row, guards_reject };
using Pair = std::pair<std::string, std::string>;  // state, event

const char* key_of(Entry entry) { return entry == Entry::no_row ? "no_row" : "guards_reject"; }

YAML::Node machines_in_list() {
  static const YAML::Node file = YAML::LoadFile(STORMPROOF_SPECS_DIR "/ignored-pairs.yaml");
  return file["machines"];
}

/// The listed pairs of one machine and one kind. A pair that is listed twice fails the test.
std::set<Pair> listed(std::string_view machine, Entry entry) {
  std::set<Pair> pairs;
  const YAML::Node groups = machines_in_list()[std::string{machine}][key_of(entry)];
  for (const YAML::Node& group : groups) {
    for (const YAML::Node& event : group["events"]) {
      const Pair pair{group["state"].as<std::string>(), event.as<std::string>()};
      EXPECT_TRUE(pairs.insert(pair).second)
          << machine << ": twice: " << pair.first << ", " << pair.second;
    }
  }
  return pairs;
}

std::set<Pair> observed(const MachineSurvey& survey, Entry entry) {
  std::set<Pair> pairs;
  for (const PairSurvey& pair : survey.pairs) {
    const bool member =
        entry == Entry::no_row ? !pair.has_row : pair.has_row && pair.none_enabled > 0;
    if (!member) continue;
    pairs.emplace(survey.info.states[pair.state], survey.info.events[pair.event]);
  }
  return pairs;
}

void expect_same(Entry entry) {
  for (const MachineSurvey& survey : all_surveys()) {
    const std::set<Pair> in_list = listed(survey.info.name, entry);
    const std::set<Pair> in_table = observed(survey, entry);
    for (const Pair& pair : in_table) {
      EXPECT_TRUE(in_list.contains(pair))
          << survey.info.name << ", " << key_of(entry) << ": not listed: " << pair.first << " on "
          << pair.second;
    }
    for (const Pair& pair : in_list) {
      EXPECT_TRUE(in_table.contains(pair))
          << survey.info.name << ", " << key_of(entry) << ": listed, but not so: " << pair.first
          << " on " << pair.second;
    }
  }
}

TEST(Totality, EveryPairHasARowOrIsListed) { expect_same(Entry::no_row); }

TEST(Totality, EveryPairWhoseGuardsCanAllBeFalseIsListed) { expect_same(Entry::guards_reject); }

TEST(Totality, TheListNamesEveryMachineAndNoOther) {
  std::set<std::string> names;
  for (const auto& machine : machines_in_list()) names.insert(machine.first.as<std::string>());
  std::set<std::string> expected;
  for (const MachineSurvey& survey : all_surveys()) expected.emplace(survey.info.name);
  EXPECT_EQ(names, expected);
}

TEST(Totality, TheListKnowsOnlyItsOwnKeysAndNamesOnlyWhatExists) {
  for (const MachineSurvey& survey : all_surveys()) {
    const auto& info = survey.info;
    for (const auto& section : machines_in_list()[std::string{info.name}]) {
      const auto key = section.first.as<std::string>();
      ASSERT_TRUE(key == "no_row" || key == "guards_reject") << info.name << ": " << key;
      for (const YAML::Node& group : section.second) {
        const auto state = group["state"].as<std::string>();
        EXPECT_EQ(std::count(info.states.begin(), info.states.end(), state), 1)
            << info.name << ": " << state;
        for (const YAML::Node& node : group["events"]) {
          const auto event = node.as<std::string>();
          EXPECT_EQ(std::count(info.events.begin(), info.events.end(), event), 1)
              << info.name << ": " << event;
        }
      }
    }
  }
}

TEST(Totality, EveryEntryGivesAReasonAndSaysWhetherItOccurs) {
  for (const auto& machine : machines_in_list()) {
    for (const auto& section : machine.second) {
      const bool no_row = section.first.as<std::string>() == "no_row";
      for (const YAML::Node& group : section.second) {
        const auto place =
            machine.first.as<std::string>() + ": " + group["state"].as<std::string>();
        const auto reason = group["reason"].as<std::string>("");
        EXPECT_GE(reason.size(), 20U) << place;
        EXPECT_EQ(reason.empty() ? ' ' : reason.back(), '.') << place;
        EXPECT_EQ(group["occurs"].IsDefined(), no_row) << place;
        if (no_row) {
          EXPECT_NO_THROW((void)group["occurs"].as<bool>()) << place;
        }
        EXPECT_EQ(group.size(), no_row ? 4U : 3U) << place << ": unknown key";
      }
    }
  }
}

}  // namespace totality_test
}  // namespace stormproof::fsm
