// Each kind of mistake in a table: what it changes, and that the rest of the table stays as it is.
#include "fsm/table_mutation.hpp"

#include <gtest/gtest.h>

#include "fsm/descriptor_repair.hpp"
#include "fsm/flyweight.hpp"
#include "fsm/row_table.hpp"
#include "tests/fsm/table_law.hpp"

namespace stormproof::fsm {
namespace table_mutation_test {

using namespace descriptor_repair;
using M = DescriptorRepair;
using Info = Reflect<M>;
using Kind = TableMutation::Kind;
using Input = Flyweight<M>::Input;
using Output = Flyweight<M>::Output;

// Positions in the table.
constexpr std::size_t u_listed = 0;     // U + AckNackReceived [Listed] / Request -> R
constexpr std::size_t r_due = 1;        // R + RepairDue / Generate -> Q
constexpr std::size_t u_confirmed = 4;  // U + AckNackReceived [Confirmed] -> A

constexpr Input listed{.listed = true, .below_first_missing = false, .prefix_only = false};
constexpr Input confirmed{.listed = false, .below_first_missing = true, .prefix_only = false};

std::vector<Input> inputs() {
  std::vector<Input> all;
  for (int bits = 0; bits < 8; ++bits) {
    all.push_back({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
  }
  return all;
}

/// (state, event) pairs on which the mutated table does something else than MSM for some input.
template <class... Events>
std::vector<std::string> differences(const TableInterpreter<M>& table, TypeList<Events...>) {
  std::vector<std::string> found;
  Flyweight<M> msm;
  const auto compare = [&]<class E>(StateId state, E*) {
    for (const Input& input : inputs()) {
      if (interpreter_agrees<M, E>(table, msm, state, input)) continue;
      found.push_back(std::string{Info::state_names[state]} + " " + std::string{name_of<E>()});
      return;
    }
  };
  for (StateId state = 0; state < Info::state_count; ++state) {
    (compare(state, static_cast<Events*>(nullptr)), ...);
  }
  return found;
}

struct Mutant {
  explicit Mutant(TableMutation mutation) : mutations{std::move(mutation)}, table{mutations} {}
  [[nodiscard]] std::vector<std::string> changed() const {
    return differences(table, Info::Events{});
  }
  template <class Source, class E>
  StepResult step(const Input& input, Output& output) const {
    return table.step(Info::id<Source>, Info::event_id<E>, input, output);
  }
  std::vector<TableMutation> mutations;
  TableInterpreter<M> table;
};

using Pairs = std::vector<std::string>;

TEST(TableMutations, NoneLeavesTheTableAsItIs) {
  EXPECT_EQ(differences(TableInterpreter<M>{}, Info::Events{}), Pairs{});
}

TEST(TableMutations, OfAnotherMachineLeaveTheTableAsItIs) {
  EXPECT_EQ((Mutant{{"ChangeForReader", r_due, Kind::drop_row, 0, 0}}.changed()), Pairs{});
}

TEST(TableMutations, DropRow) {
  const Mutant mutant{{"DescriptorRepair", r_due, Kind::drop_row, 0, 0}};
  Output output{};
  const StepResult result = mutant.step<R, RepairDue>({}, output);
  EXPECT_EQ(result.state, Info::id<R>);
  EXPECT_FALSE(result.fired());
  EXPECT_FALSE(output.generate);
  EXPECT_EQ(mutant.changed(), Pairs{"R RepairDue"});
}

TEST(TableMutations, Retarget) {
  const Mutant mutant{{"DescriptorRepair", r_due, Kind::retarget, 0, Info::id<S>}};
  Output output{};
  EXPECT_EQ((mutant.step<R, RepairDue>({}, output).state), Info::id<S>);
  EXPECT_TRUE(output.generate);
  EXPECT_EQ(mutant.changed(), Pairs{"R RepairDue"});
}

TEST(TableMutations, NegateGuard) {
  const Mutant mutant{{"DescriptorRepair", u_listed, Kind::negate_guard, 0, 0}};
  Output output{};
  EXPECT_FALSE((mutant.step<U, AckNackReceived>(listed, output).fired()));
  // Both rows are enabled: the later one, which confirms, wins.
  EXPECT_EQ((mutant.step<U, AckNackReceived>(confirmed, output).state), Info::id<A>);
  EXPECT_EQ((mutant.step<U, AckNackReceived>({false, false, true}, output).state), Info::id<R>);
  EXPECT_EQ(mutant.changed(), Pairs{"U AckNackReceived"});
}

TEST(TableMutations, NegateTheGuardOfARowWithoutOne) {
  const Mutant mutant{{"DescriptorRepair", r_due, Kind::negate_guard, 0, 0}};
  Output output{};
  EXPECT_FALSE((mutant.step<R, RepairDue>({}, output).fired()));
}

TEST(TableMutations, IgnoreGuard) {
  const Mutant mutant{{"DescriptorRepair", u_confirmed, Kind::ignore_guard, 0, 0}};
  Output output{};
  const StepResult result = mutant.step<U, AckNackReceived>(listed, output);
  EXPECT_EQ(result.state, Info::id<A>);
  EXPECT_FALSE(output.requested);
  EXPECT_EQ(mutant.changed(), Pairs{"U AckNackReceived"});
}

TEST(TableMutations, DropAction) {
  const Mutant mutant{{"DescriptorRepair", u_listed, Kind::drop_action, 0, 0}};
  Output output{};
  const StepResult result = mutant.step<U, AckNackReceived>(listed, output);
  EXPECT_EQ(result.state, Info::id<R>);
  EXPECT_TRUE(result.fired());
  EXPECT_FALSE(output.requested);
  EXPECT_EQ(mutant.changed(), Pairs{"U AckNackReceived"});
}

TEST(TableMutations, CopyRow) {
  const Mutant mutant{{"DescriptorRepair", u_listed, Kind::copy_row, Info::id<A>, Info::id<R>}};
  Output output{};
  EXPECT_EQ((mutant.step<A, AckNackReceived>(listed, output).state), Info::id<R>);
  EXPECT_TRUE(output.requested);
  EXPECT_FALSE((mutant.step<A, AckNackReceived>(confirmed, output).fired()));
  EXPECT_EQ(mutant.changed(), Pairs{"A AckNackReceived"});
}

TEST(TableMutations, SeveralAddUpByTheNumbersOfTheCorrectTable) {
  const std::vector<TableMutation> mutations{
      {"DescriptorRepair", u_listed, Kind::drop_row, 0, 0},
      {"DescriptorRepair", r_due, Kind::retarget, 0, Info::id<U>}};
  const TableInterpreter<M> table{mutations};
  EXPECT_EQ(differences(table, Info::Events{}), (Pairs{"U AckNackReceived", "R RepairDue"}));
}

}  // namespace table_mutation_test
}  // namespace stormproof::fsm
