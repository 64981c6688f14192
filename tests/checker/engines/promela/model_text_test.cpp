// The models say what the tables and the rules say: a mistake in one of them is a mistake in the
// model, and nothing else changes.
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "checker/engines/promela/promela.hpp"
#include "fsm/machines.hpp"
#include "tests/checker/engines/promela/mistakes.hpp"

namespace stormproof::promela {
namespace model_text_test {

using Kind = fsm::TableMutation::Kind;
using Lines = std::vector<std::string>;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in{text};
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// Lines of `a` that `b` does not have.
std::vector<std::string> only_in(const std::string& a, const std::string& b) {
  const std::vector<std::string> others = lines(b);
  std::vector<std::string> found;
  for (const std::string& line : lines(a)) {
    if (std::ranges::find(others, line) == others.end()) found.push_back(line);
  }
  return found;
}

model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}
std::string paper_with(const std::vector<fsm::TableMutation>& tables) {
  return promela_of(2, {}, in_tables(tables));
}

TEST(ModelText, HasEveryRowOfTheTable) {
  const auto count_options = [](const std::string& model, const std::string& machine) {
    return std::ranges::count_if(lines(model), [&](const std::string& line) {
      return line.starts_with("  :: state == " + machine + "_");
    });
  };
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    const auto rows = static_cast<std::ptrdiff_t>(machine.rows.size());
    const std::string name{machine.name};
    if (name == "DescriptorRepair" || name == "DiscoveryReader" || name == "InitialAckNack") {
      EXPECT_EQ(count_options(promela_of(1, {}), name), rows) << name;
    }
    if (name == "ChangeForReader" || name == "SingleShot") {
      EXPECT_EQ(count_options(promela_of(1, fastdds()), name), rows) << name;
    }
  }
}

/// Rules that announce, and those of the adaptive policy, are no processes.
TEST(ModelText, HasAProcessForEveryRuleThatHappens) {
  Lines processes;
  for (const std::string& line : lines(promela_of(2, {}))) {
    if (line.starts_with("active proctype "))
      processes.push_back(line.substr(16, line.find('(') - 16));
  }
  EXPECT_EQ(processes,
            (Lines{"WriterIsHeard", "InitialAckNackDue", "DataArrives", "HeartbeatArrives",
                   "AckNackDue", "AckNackArrives", "RepairIsDue", "RepairHasLeft",
                   "SuppressionEnds", "HeartbeatExpires", "Loss", "Rest"}));
}

TEST(ModelText, SaysWhatAGuardTests) {
  const std::string right = paper_with({});
  const std::string rule =
      "  :: state == DescriptorRepair_Q && Confirmed -> state = DescriptorRepair_A";
  EXPECT_NE(right.find(rule + "\n"), std::string::npos);
  const std::string wrong = paper_with({{"DescriptorRepair", 6, Kind::ignore_guard, 0, 0}});
  EXPECT_EQ(only_in(wrong, right),
            Lines{"  :: state == DescriptorRepair_Q -> state = DescriptorRepair_A"});
  EXPECT_EQ(only_in(right, wrong), Lines{rule});
}

/// What confirms is the guard's own body, with the knob of the profile in its place.
TEST(ModelText, EvaluatesGuardsOnWhatARuleFeeds) {
  const std::string feed = "DescriptorRepair_AckNackReceived(c[0], 0, (AckNack_Listed >> 0 & 1), ";
  EXPECT_NE(paper_with({}).find(feed + "!(AckNack_Listed >> 0 & 1));"), std::string::npos);
  model::DdsProfile prefix;
  prefix.sedp.acknowledge = model::Acknowledge::prefix;
  EXPECT_NE(promela_of(2, prefix).find(
                feed + "(!(AckNack_Listed >> 0 & 1) && (AckNack_BelowBase >> 0 & 1)));"),
            std::string::npos);
}

TEST(ModelText, OfTwoEnabledRowsTheLaterOneWins) {
  const std::string model = paper_with({{"DescriptorRepair", 4, Kind::ignore_guard, 0, 0}});
  EXPECT_NE(model.find("  :: state == DescriptorRepair_U -> state = DescriptorRepair_A\n"),
            std::string::npos);
  EXPECT_EQ(model.find("state = DescriptorRepair_R"), std::string::npos);  // never reached any more
}

TEST(ModelText, LeavesOutWhatADroppedActionAskedFor) {
  const std::string right = promela_of(1, fastdds());
  const std::string wrong =
      promela_of(1, fastdds(), in_tables({{"ChangeForReader", 5, Kind::drop_action, 0, 0}}));
  EXPECT_EQ(wrong, right);  // the end of a suppression asks for nothing
  const std::string silent =
      promela_of(1, fastdds(), in_tables({{"ChangeForReader", 2, Kind::drop_action, 0, 0}}));
  EXPECT_EQ(silent.find("ChangeForReader_requested"), std::string::npos);
  EXPECT_EQ(silent.find("NackResponds"), std::string::npos);  // nothing ever makes it due
}

/// And with it what only it makes happen.
TEST(ModelText, DropsAnEffect) {
  const std::string right = promela_of(1, {});
  const std::string wrong = promela_of(1, {}, at_effect("paper", "RepairHasLeft.2", Change::drop));
  const Lines dropped = only_in(right, wrong);
  for (const char* const line :
       {"              SuppressionEnd = true;", "active proctype SuppressionEnds() {"}) {
    EXPECT_EQ(std::ranges::count(dropped, line), 1) << line;
  }
  EXPECT_EQ(only_in(wrong, right), Lines{});
}

/// A model has no times, and says so instead of leaving something out.
TEST(ModelText, RefusesAPolicyThatDecidesByTheTime) {
  model::DdsProfile adaptive;
  adaptive.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  EXPECT_THROW((void)promela_of(1, adaptive), std::logic_error);
}

}  // namespace model_text_test
}  // namespace stormproof::promela
