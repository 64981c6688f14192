// The models say what the tables say: a mistake in a table is a mistake in the model, and nothing
// else changes.
#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "checker/engines/promela/promela.hpp"
#include "fsm/machines.hpp"

namespace stormproof::promela {
namespace model_text_test {

using Kind = fsm::TableMutation::Kind;

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

using Lines = std::vector<std::string>;

TEST(ModelText, HasEveryRowOfTheTable) {
  const auto count_options = [](const std::string& model) {
    return std::ranges::count_if(lines(model), [](const std::string& line) {
      return line.starts_with("  :: state[d] == ");
    });
  };
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    const auto rows = static_cast<std::ptrdiff_t>(machine.rows.size());
    if (machine.name == "DescriptorRepair") {
      EXPECT_EQ(count_options(promela_of_descriptor_repair(1)), rows);
    }
    if (machine.name == "ChangeForReader") {
      // and the test for Q in SEND_IF_QUEUED
      EXPECT_EQ(count_options(promela_of_change_for_reader(1)), rows + 1);
    }
  }
}

TEST(ModelText, ListsTheInputsOnWhichAGuardHolds) {
  const std::string right = promela_of_descriptor_repair(2);
  // Confirmed: not listed, and with the prefix rule (input 2) below the first missing (input 1).
  EXPECT_NE(right.find("  :: state[d] == Q && (in == 0 || in == 2 || in == 6) -> state[d] = A\n"),
            std::string::npos);
  const std::vector<fsm::TableMutation> ignored{{"DescriptorRepair", 6, Kind::ignore_guard, 0, 0}};
  const std::string wrong = promela_of_descriptor_repair(2, ignored);
  EXPECT_EQ(only_in(wrong, right), Lines{"  :: state[d] == Q -> state[d] = A"});
  EXPECT_EQ(only_in(right, wrong),
            Lines{"  :: state[d] == Q && (in == 0 || in == 2 || in == 6) -> state[d] = A"});
}

TEST(ModelText, OfTwoEnabledRowsTheLaterOneWins) {
  const std::vector<fsm::TableMutation> both{{"DescriptorRepair", 4, Kind::ignore_guard, 0, 0}};
  const std::string model = promela_of_descriptor_repair(1, both);
  EXPECT_NE(model.find("  :: state[d] == U -> state[d] = A\n"), std::string::npos);
  EXPECT_EQ(model.find("state[d] = R"), std::string::npos);  // never reached any more
}

TEST(ModelText, LeavesOutWhatADroppedActionAskedFor) {
  const std::vector<fsm::TableMutation> silent{{"ChangeForReader", 2, Kind::drop_action, 0, 0}};
  EXPECT_EQ(only_in(promela_of_change_for_reader(1, silent), promela_of_change_for_reader(1)),
            Lines{"  :: state[d] == U && (in == 1) -> state[d] = R"});
}

}  // namespace model_text_test
}  // namespace stormproof::promela
