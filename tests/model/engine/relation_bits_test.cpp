// The reader's bitmap and the mark of first generation, for numbers of descriptors around the
// borders of words. What the writer's machine does with a relation is tested where its events are:
// tests/model/paper/descriptor_rules_test.cpp.
#include "model/engine/relation_bits.hpp"

#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fsm/descriptor_repair.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace relation_bits_test {

using Bits = RelationBits<fsm::DescriptorRepair>;
using Members = std::set<std::uint32_t>;

DescriptorSet to_set(const Members& members, std::uint32_t count) {
  std::vector<std::uint64_t> words(words_for(count));
  for (const std::uint32_t d : members) words[d / 64] |= std::uint64_t{1} << d % 64;
  return DescriptorSet{words};
}

Members to_members(const DescriptorSet& set) {
  Members members;
  set.for_each([&](std::uint32_t d) { members.insert(d); });
  return members;
}

Members random_members(std::uint32_t count) {
  return *rc::gen::container<Members>(rc::gen::inRange<std::uint32_t>(0, count));
}

RC_GTEST_PROP(RelationBits, TheReaderSideIsABitmap, ()) {
  const auto count = *rc::gen::element<std::uint32_t>(1, 63, 64, 65, 130, 200);
  const Scenario scenario = by_hand({{0, count}, {1, 0}});
  RunState run{scenario, nullptr};
  Bits bits{run};
  Members missing = to_members(bits.missing(0));
  RC_ASSERT(missing.size() == count);
  RC_ASSERT(*missing.rbegin() == count - 1);
  for (int k = *rc::gen::inRange(0, 6); k > 0; --k) {
    const Members data = random_members(count);
    std::uint32_t fresh = 0;
    for (const std::uint32_t d : data) fresh += missing.contains(d) ? 1U : 0U;
    RC_ASSERT(bits.count_missing(0, to_set(data, count)) == fresh);
    bits.receive(0, to_set(data, count));
    RC_ASSERT(bits.count_missing(0, to_set(data, count)) == 0U);
    for (const std::uint32_t d : data) missing.erase(d);
    RC_ASSERT(to_members(bits.missing(0)) == missing);
    for (std::uint32_t d = 0; d < count; ++d) {
      RC_ASSERT((bits.received(0, d / 64) >> d % 64 & 1) != (missing.contains(d) ? 1U : 0U));
    }
  }
}

TEST(RelationBits, FirstGenerationIsTold) {
  const Scenario scenario = by_hand({{0, 70}, {1, 0}});
  RunState run{scenario, nullptr};
  Bits bits{run};
  for (const std::uint32_t d : {0U, 63U, 64U, 69U}) {
    EXPECT_TRUE(bits.mark_generated(0, d));
    EXPECT_FALSE(bits.mark_generated(0, d));
  }
  EXPECT_TRUE(bits.mark_generated(0, 1));
}

/// What a probe is told of the writer's machines.
struct Told : Probe {
  void transition(const Transition& fired) override {
    lines.push_back(std::string{fired.event} + ": " + std::string{fired.before} + " → " +
                    std::string{fired.after} + " " + std::to_string(fired.descriptors));
  }
  std::vector<std::string> lines;
};

/// No row of a correct table keeps its state, so a mistake makes one.
TEST(RelationBits, ARowThatKeepsItsStateIsTold) {
  using Repair = fsm::Reflect<fsm::DescriptorRepair>;
  const auto rows = Repair::info().rows;
  fsm::TableMutation keep;
  keep.machine = Repair::info().name;
  keep.kind = fsm::TableMutation::Kind::retarget;
  keep.target = Repair::id<fsm::descriptor_repair::U>;
  while (rows[keep.row].target != Repair::id<fsm::descriptor_repair::R>) ++keep.row;
  Mutation mutation;
  mutation.tables.push_back(keep);
  const Scenario scenario = by_hand({{0, 3}, {1, 0}});
  Told told;
  RunState run{scenario, &told, &mutation};
  Bits bits{run};
  const auto nothing = [](auto&&...) {};
  bits.step<fsm::descriptor_repair::AckNackReceived>(0, 0, 5, {.listed = true}, nothing);
  EXPECT_EQ(told.lines, std::vector<std::string>{"AckNackReceived: U → U 5"});
  bits.step<fsm::descriptor_repair::RepairDue>(0, 0, 7, {}, nothing);  // no row
  EXPECT_EQ(told.lines.size(), 1U);
}

TEST(RelationBits, ARelationWithoutDescriptorsIsEmpty) {
  const Scenario scenario = by_hand({{0, 3}, {1, 0}});
  RunState run{scenario, nullptr};
  Bits bits{run};
  EXPECT_TRUE(bits.missing(1).empty());
}

}  // namespace relation_bits_test
}  // namespace stormproof::model
