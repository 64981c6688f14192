// The repair state of a descriptor whose reader may forget: the rows of the paper's machine, and
// two ways out of A. The oracle knows no requests for what was acknowledged.
#include "fsm/reopening_repair.hpp"

#include <gtest/gtest.h>

#include "fsm/msm.hpp"

namespace stormproof::fsm {
namespace reopening_repair_test {

TEST(ReopeningRepair, HasTheRowsOfTheMachineThatItExtendsAndTwoMore) {
  const MachineInfo usual = Reflect<DescriptorRepair>::info();
  const MachineInfo reopening = Reflect<ReopeningRepair>::info();
  EXPECT_EQ(reopening.states, usual.states);
  ASSERT_EQ(reopening.rows.size(), usual.rows.size() + 2);
  const auto in_words = [](const MachineInfo& machine, const RowInfo& row) {
    const auto word = [](std::string_view text) { return " " + std::string{text}; };
    return std::string{machine.states[row.source]} + word(machine.events[row.event]) +
           word(row.guard) + word(row.action) + word(machine.states[row.target]);
  };
  for (std::size_t k = 0; k < usual.rows.size(); ++k) {
    EXPECT_EQ(in_words(reopening, reopening.rows[k]), in_words(usual, usual.rows[k]));
  }
  EXPECT_EQ(in_words(reopening, *(reopening.rows.end() - 2)), "A ReaderForgot none none U");
  EXPECT_EQ(in_words(reopening, reopening.rows.back()), "A RequestedAgain none Request R");
}

}  // namespace reopening_repair_test
}  // namespace stormproof::fsm
