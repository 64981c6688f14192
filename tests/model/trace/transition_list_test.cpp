// Words of one relation merge; everything else stays apart.
#include "model/trace/transition_list.hpp"

#include <gtest/gtest.h>

namespace stormproof::model::trace {
namespace transition_list_test {

constexpr MachineRef repair{"DescriptorRepair", MachineRef::Kind::relation, 5};
constexpr MachineRef other{"DescriptorRepair", MachineRef::Kind::relation, 6};
constexpr MachineRef timer{"HeartbeatTimer", MachineRef::Kind::writer, 1};

TEST(TransitionList, MergesTheWordsOfARelation) {
  TransitionList list;
  list.add({repair, "AckNackReceived", "U", "R", 0, 0b1});
  list.add({repair, "AckNackReceived", "U", "A", 0, 0b10});
  list.add({repair, "AckNackReceived", "U", "R", 2, 0b100});
  list.add({repair, "AckNackReceived", "U", "A", 0, 0b1000});
  ASSERT_EQ(list.entries().size(), 2U);
  EXPECT_EQ(list.entries()[0].words, (std::vector<std::uint64_t>{0b1, 0, 0b100}));
  EXPECT_EQ(list.entries()[1].words, (std::vector<std::uint64_t>{0b1010}));
}

TEST(TransitionList, KeepsRelationsAndEventsApart) {
  TransitionList list;
  list.add({repair, "RepairDue", "R", "Q", 0, 1});
  list.add({other, "RepairDue", "R", "Q", 0, 1});
  list.add({repair, "RepairDue", "R", "Q", 0, 1});
  list.add({repair, "RepairSent", "Q", "S", 0, 1});
  EXPECT_EQ(list.entries().size(), 4U);
}

TEST(TransitionList, MachinesWithoutDescriptorsNeverMerge) {
  TransitionList list;
  list.add({timer, "Expired", "Armed", "Armed", 0, 0});
  list.add({timer, "Expired", "Armed", "Armed", 0, 0});
  EXPECT_EQ(list.entries().size(), 2U);
  EXPECT_TRUE(list.entries()[0].words.empty());
}

TEST(TransitionList, ForgetsWhatWasCleared) {
  TransitionList list;
  list.add({repair, "RepairDue", "R", "Q", 3, 1});
  list.clear();
  EXPECT_TRUE(list.entries().empty());
  list.add({repair, "RepairDue", "R", "Q", 0, 1});
  ASSERT_EQ(list.entries().size(), 1U);
  EXPECT_EQ(list.entries()[0].words, (std::vector<std::uint64_t>{1}));
}

}  // namespace transition_list_test
}  // namespace stormproof::model::trace
