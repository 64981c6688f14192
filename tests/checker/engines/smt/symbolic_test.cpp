// The symbolic domain means what plain execution means: on constants, every guard and every action
// of every machine gives over solver expressions what it gives over plain values.
#include "checker/engines/smt/symbolic.hpp"

#include <random>

#include <boost/pfr.hpp>
#include <gtest/gtest.h>

#include "fsm/announcer.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/channel.hpp"
#include "fsm/control_relation.hpp"
#include "fsm/descriptor_repair.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "fsm/row_table.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::smt {
namespace symbolic_test {

using Dice = std::mt19937;

void draw(bool& value, Dice& dice) { value = dice() % 2 == 0; }
/// Small numbers meet often; the machines divide by positive numbers only.
void draw(std::int64_t& value, Dice& dice) { value = 1 + static_cast<std::int64_t>(dice() % 6); }
template <class Fields>
void draw(Fields& fields, Dice& dice) {
  boost::pfr::for_each_field(fields, [&](auto& field) { draw(field, dice); });
}

void lift(bool plain, SymbolicBool& symbolic) { symbolic = plain; }
void lift(std::int64_t plain, SymbolicInt& symbolic) { symbolic = plain; }
template <class Plain, class Lifted>
void lift(const Plain& plain, Lifted& symbolic) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (lift(boost::pfr::get<I>(plain), boost::pfr::get<I>(symbolic)), ...);
  }
  (std::make_index_sequence<boost::pfr::tuple_size_v<Plain>>{});
}

std::string text_of(bool value) { return value ? "true" : "false"; }
std::string text_of(std::int64_t value) { return std::to_string(value); }
std::string text_of(const SymbolicBool& value) { return value.expr().simplify().to_string(); }
std::string text_of(const SymbolicInt& value) {
  const z3::expr constant = value.expr().simplify();
  return std::to_string(constant.get_numeral_int64());
}
template <class Fields>
std::string all_of(const Fields& fields) {
  std::string text;
  boost::pfr::for_each_field(fields, [&](const auto& field) { text += text_of(field) + " "; });
  return text;
}

template <class Machine>
class SymbolicDomain : public testing::Test {};

using Machines =
    testing::Types<fsm::DescriptorRepair, fsm::DiscoveryReader, fsm::HeartbeatTimer,
                   fsm::InitialAckNack, fsm::Announcer, fsm::Channel, fsm::ChangeForReader,
                   fsm::SingleShot, fsm::ControlWriter, fsm::ControlReader>;
TYPED_TEST_SUITE(SymbolicDomain, Machines);

TYPED_TEST(SymbolicDomain, AgreesWithPlainExecution) {
  z3::context context;
  const SymbolicContext current{context};
  const fsm::RowTable<TypeParam, fsm::Plain> plain;
  const fsm::RowTable<TypeParam, Symbolic> symbolic;
  ASSERT_EQ(plain.rows().size(), symbolic.rows().size());
  Dice dice{1};
  for (int round = 0; round < 60; ++round) {
    typename fsm::RowTable<TypeParam, fsm::Plain>::Input plain_input;
    typename fsm::RowTable<TypeParam, Symbolic>::Input symbolic_input;
    draw(plain_input, dice);
    lift(plain_input, symbolic_input);
    for (std::size_t k = 0; k < plain.rows().size(); ++k) {
      EXPECT_EQ(text_of(plain.rows()[k].enabled(plain_input)),
                text_of(symbolic.rows()[k].enabled(symbolic_input)));
      if (plain.rows()[k].action == nullptr) continue;
      typename fsm::RowTable<TypeParam, fsm::Plain>::Output plain_output{};
      typename fsm::RowTable<TypeParam, Symbolic>::Output symbolic_output;
      plain.rows()[k].action(plain_input, plain_output);
      symbolic.rows()[k].action(symbolic_input, symbolic_output);
      EXPECT_EQ(all_of(plain_output), all_of(symbolic_output)) << "row " << k;
    }
  }
}

TEST(SymbolicValues, StartAsFalseAndZero) {
  z3::context context;
  const SymbolicContext current{context};
  EXPECT_EQ(text_of(SymbolicBool{}), "false");
  EXPECT_EQ(text_of(SymbolicInt{}), "0");
}

TEST(SymbolicValues, ContextsNest) {
  z3::context outer;
  z3::context inner;
  const SymbolicContext current{outer};
  {
    const SymbolicContext nested{inner};
    EXPECT_EQ(&SymbolicContext::current(), &inner);
  }
  EXPECT_EQ(&SymbolicContext::current(), &outer);
}

}  // namespace symbolic_test
}  // namespace stormproof::smt
