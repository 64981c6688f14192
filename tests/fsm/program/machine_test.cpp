// The terms of a recorded machine compute what its guards and actions do: on random inputs, in all
// states, each row fires exactly if that of the table does, and asks for the same.
#include "fsm/program/machine.hpp"

#include <map>
#include <random>

#include <gtest/gtest.h>

#include "fsm/row_table.hpp"

namespace stormproof::fsm::program {
namespace machine_test {

using Int = std::int64_t;

/// Terms of machines over plain numbers; a truth value is 0 or 1.
class Computed {
 public:
  Computed(const Program& program, std::vector<Int> given)
      : program_{program}, given_{std::move(given)} {}

  Int operator()(Ref ref) {
    const auto known = known_.find(ref);
    return known != known_.end() ? known->second : known_[ref] = compute(program_.terms[ref]);
  }

 private:
  Int compute(const Term& term) {
    const auto a = [&] { return (*this)(term.a); };
    const auto b = [&] { return (*this)(term.b); };
    using enum Op;
    switch (term.op) {
      case truth:
      case integer:
        return term.value;
      case input:
        return given_.at(static_cast<std::size_t>(term.value));
      case named:
        return a();
      case negation:
        return a() == 0;
      case both:
        return a() & b();
      case either:
        return a() | b();
      case plus:
        return a() + b();
      case minus:
        return a() - b();
      case times:
        return a() * b();
      case over:
        return a() / b();
      case equal:
        return a() == b();
      case unequal:
        return a() != b();
      case less:
        return a() < b();
      case at_most:
        return a() <= b();
      case greater:
        return a() > b();
      case at_least:
        return a() >= b();
      case select:
        return a() != 0 ? b() : (*this)(term.c);
      default:
        ADD_FAILURE() << "no term of a machine";
        return 0;
    }
  }

  const Program& program_;
  std::vector<Int> given_;
  std::map<Ref, Int> known_;
};

template <class Fields>
std::vector<Int> values_of(const Fields& fields) {
  std::vector<Int> values;
  for_each_value<bool, Int>(fields, [&](const auto& value) { values.push_back(value); });
  return values;
}

template <class M>
class RecordedMachine : public testing::Test {};
using Machines =
    testing::Types<DescriptorRepair, DiscoveryReader, HeartbeatTimer, InitialAckNack, Announcer,
                   ChangeForReader, SingleShot, ControlWriter, ControlReader, CautiousReader,
                   MatchedReader, HeartbeatPacer, EventThread, MovableTimer>;
TYPED_TEST_SUITE(RecordedMachine, Machines);

TYPED_TEST(RecordedMachine, ComputesWhatTheTableDoes) {
  Program program;
  const Recording recording{program};
  const Machine machine = recorded_machine<TypeParam>();
  const RowTable<TypeParam> table;
  ASSERT_EQ(machine.rows.size(), table.rows().size());
  std::mt19937 random{7};
  for (int round = 0; round < 200; ++round) {
    typename TypeParam::Io::template Input<Plain> input{};
    for_each_value<bool, Int>(input, [&]<class Field>(Field& field) {
      field = static_cast<Field>(std::is_same_v<Field, bool> ? random() % 2
                                                             : 1 + random() % 6);  // divisors, too
    });
    Computed computed{program, values_of(input)};
    for (std::size_t r = 0; r < machine.rows.size(); ++r) {
      const Machine::Row& row = machine.rows[r];
      const auto& expected = table.rows()[r];
      EXPECT_EQ(row.source, expected.source);
      EXPECT_EQ(row.event, expected.event);
      EXPECT_EQ(row.target, expected.target);
      const bool enabled = row.guard == no_term || computed(row.guard) != 0;
      EXPECT_EQ(enabled, expected.enabled(input)) << r;
      typename TypeParam::Io::template Output<Plain> output{};
      if (expected.action != nullptr) expected.action(input, output);
      std::vector<Int> asked;
      for (const Ref out : row.out) {
        asked.push_back(out == no_term ? 0 : computed(out));
      }
      EXPECT_EQ(asked, values_of(output)) << r;
    }
  }
}

/// Mistakes are made in recorded rows as in those that are executed.
TEST(RecordedRows, HaveTheMistakesOfTheTable) {
  using Kind = TableMutation::Kind;
  Program program;
  const Recording recording{program};
  const Machine machine = recorded_machine<DescriptorRepair>();
  const std::vector<TableMutation> mistakes{
      {"DescriptorRepair", 0, Kind::drop_row},       {"DescriptorRepair", 4, Kind::negate_guard},
      {"DescriptorRepair", 5, Kind::ignore_guard},   {"DescriptorRepair", 1, Kind::drop_action},
      {"DescriptorRepair", 2, Kind::copy_row, 0, 3}, {"HeartbeatTimer", 3, Kind::drop_row}};
  const auto rows = rows_of(machine, mistakes);
  const auto table = RowTable<DescriptorRepair>{mistakes};
  ASSERT_EQ(rows.size(), table.rows().size());
  ASSERT_EQ(rows.size(), machine.rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_EQ(rows[r].source, table.rows()[r].source);
    EXPECT_EQ(rows[r].target, table.rows()[r].target);
    EXPECT_EQ(rows[r].negated, table.rows()[r].negated);
    EXPECT_EQ(rows[r].guard == no_term, table.rows()[r].guard == nullptr);
    const bool asks = std::ranges::any_of(rows[r].out, [](Ref out) { return out != no_term; });
    EXPECT_EQ(asks, table.rows()[r].action != nullptr) << r;
  }
}

}  // namespace machine_test
}  // namespace stormproof::fsm::program
