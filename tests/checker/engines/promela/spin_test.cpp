// SPIN verifies the models of both writers, and finds the mistake in mutated ones: acknowledging
// what was not confirmed, a repair that never comes, a state that nothing leaves.
#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "checker/engines/promela/promela.hpp"
#include "checker/engines/promela/run_spin.hpp"

namespace stormproof::promela {
namespace spin_test {

using Kind = fsm::TableMutation::Kind;

class Spin : public testing::Test {
 protected:
  void SetUp() override {
    if (!spin_is_available()) GTEST_SKIP() << "spin or gcc is not installed";
    folder_ =
        std::filesystem::temp_directory_path() / ("stormproof-promela-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  SpinRun verify(const std::string& model) {
    const auto run = run_spin(model, folder_.string());
    EXPECT_TRUE(run) << run.error();
    return run ? *run : SpinRun{};
  }
  void expect_correct(const std::string& model, std::uint64_t least_states) {
    const SpinRun run = verify(model);
    EXPECT_TRUE(run.ok) << run.error;
    EXPECT_EQ(run.error, "");
    EXPECT_GE(run.states, least_states);
    EXPECT_GT(run.seconds, 0);
  }
  void expect_error(const std::string& model, const std::string& expected) {
    const SpinRun run = verify(model);
    EXPECT_FALSE(run.ok);
    EXPECT_EQ(run.error.substr(0, expected.size()), expected);
    EXPECT_GT(run.states, 0U);
  }
  std::filesystem::path folder_;
};

std::string repair_mutant(unsigned descriptors, std::size_t row, Kind kind, std::uint8_t source = 0,
                          std::uint8_t target = 0) {
  const std::vector<fsm::TableMutation> mutations{{"DescriptorRepair", row, kind, source, target}};
  return promela_of_descriptor_repair(descriptors, mutations);
}
std::string change_mutant(unsigned descriptors, std::size_t row, Kind kind) {
  const std::vector<fsm::TableMutation> mutations{{"ChangeForReader", row, kind, 0, 0}};
  return promela_of_change_for_reader(descriptors, mutations);
}

TEST_F(Spin, VerifiesThePapersWriterWithOneDescriptor) {
  expect_correct(promela_of_descriptor_repair(1), 5'000);
}
TEST_F(Spin, VerifiesThePapersWriterWithTwoDescriptors) {
  expect_correct(promela_of_descriptor_repair(2), 200'000);
}
TEST_F(Spin, VerifiesThePapersWriterWithThreeDescriptors) {
  expect_correct(promela_of_descriptor_repair(3), 1'000'000);
}
TEST_F(Spin, VerifiesTheWriterOfFastddsWithOneDescriptor) {
  expect_correct(promela_of_change_for_reader(1), 10'000);
}

TEST_F(Spin, FindsADescriptorThatIsAcknowledgedWithoutConfirmation) {
  expect_error(repair_mutant(1, 4, Kind::ignore_guard), "safe_0: pan:1: assertion violated");
  expect_error(repair_mutant(1, 6, Kind::ignore_guard), "safe_0: pan:1: assertion violated");
}

TEST_F(Spin, FindsARequestThatLeadsToNoRepair) {
  expect_error(repair_mutant(1, 0, Kind::drop_action), "progress: pan:1: acceptance cycle");
}

TEST_F(Spin, FindsAStateThatNothingConfirms) {
  // S never ends and is never confirmed.
  const std::vector<fsm::TableMutation> stuck{{"DescriptorRepair", 3, Kind::drop_row, 0, 0},
                                              {"DescriptorRepair", 7, Kind::drop_row, 0, 0}};
  expect_error(promela_of_descriptor_repair(1, stuck), "progress: pan:1: acceptance cycle");
}

TEST_F(Spin, FindsMistakesInTheWriterOfFastdds) {
  expect_error(change_mutant(1, 6, Kind::ignore_guard), "safe_0: pan:1: assertion violated");
  expect_error(change_mutant(1, 3, Kind::drop_row), "progress: pan:1: acceptance cycle");
}

TEST_F(Spin, FindsADeadlock) {
  expect_error("byte x; active proctype P() { x == 1 -> skip }\n",
               "no deadlock: pan:1: invalid end state");
}

TEST_F(Spin, SaysWhatIsWrongWithAModel) {
  const auto run = run_spin("this is no model", folder_.string());
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().substr(0, 23), "spin failed with status");
}

TEST_F(Spin, NeedsAFolderThatExists) {
  const auto run = run_spin("", (folder_ / "absent").string());
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().find("no model can be written there"), std::string::npos);
}

}  // namespace spin_test
}  // namespace stormproof::promela
