// The symbolic step means what the interpreter of tables means, also where a mistake lets two rows
// fire: on constants both reach the same state and ask for the same things.
#include "checker/engines/tables/machine_step.hpp"

#include <gtest/gtest.h>

#include "fsm/descriptor_repair.hpp"

namespace stormproof::tables {
namespace machine_step_test {

using fsm::DescriptorRepair;
using fsm::TableMutation;
namespace repair = fsm::descriptor_repair;
using Step = MachineStep<DescriptorRepair>;

std::vector<std::vector<TableMutation>> tables() {
  std::vector<std::vector<TableMutation>> all{{}};
  for (std::size_t row = 0; row < 8; ++row) {
    for (const auto kind : {TableMutation::Kind::drop_row, TableMutation::Kind::negate_guard,
                            TableMutation::Kind::ignore_guard, TableMutation::Kind::drop_action}) {
      all.push_back({{"DescriptorRepair", row, kind}});
    }
    all.push_back({{"DescriptorRepair", row, TableMutation::Kind::copy_row, 0, 3}});
    all.push_back({{"DescriptorRepair", row, TableMutation::Kind::retarget, 0, 2}});
  }
  return all;
}

template <class Event>
void compare(const std::vector<TableMutation>& mutations) {
  z3::context context;
  const smt::SymbolicContext current{context};
  const Step symbolic{mutations};
  const fsm::TableInterpreter<DescriptorRepair> plain{mutations};
  const auto event = fsm::Reflect<DescriptorRepair>::event_id<Event>;
  for (unsigned bits = 0; bits < 8; ++bits) {
    const bool listed = (bits & 1U) != 0;
    const bool below = (bits & 2U) != 0;
    const bool prefix = (bits & 4U) != 0;
    for (fsm::StateId state = 0; state < Step::states; ++state) {
      fsm::DescriptorRepairIo::Output<fsm::Plain> output{};
      const auto expected = plain.step(
          state, event, {.listed = listed, .below_first_missing = below, .prefix_only = prefix},
          output);
      OneHot from;
      for (std::size_t k = 0; k < Step::states; ++k) from.push_back(context.bool_val(k == state));
      const auto effect = symbolic.step<Event>(
          from, {.listed = listed, .below_first_missing = below, .prefix_only = prefix},
          context.bool_val(true));
      for (std::size_t k = 0; k < Step::states; ++k) {
        EXPECT_EQ(effect.next[k].simplify().is_true(), k == expected.state);
      }
      EXPECT_EQ(effect.fires().simplify().is_true(), expected.fired());
      EXPECT_EQ(effect.asks(&Step::Output::requested).is_true(), output.requested);
      EXPECT_EQ(effect.asks(&Step::Output::generate).is_true(), output.generate);
      const auto idle = symbolic.step<Event>(from, {}, context.bool_val(false));
      EXPECT_TRUE(idle.next[state].simplify().is_true());
    }
  }
}

TEST(MachineStep, AgreesWithTheInterpreterOfTables) {
  for (const auto& mutations : tables()) {
    compare<repair::AckNackReceived>(mutations);
    compare<repair::RepairDue>(mutations);
    compare<repair::SuppressionEnded>(mutations);
  }
}

}  // namespace machine_step_test
}  // namespace stormproof::tables
