// The descriptor set against std::set: what it stores must not depend on how few words it keeps.
#include "model/engine/descriptor_set.hpp"

#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model {
namespace descriptor_set_test {

std::vector<std::uint64_t> words_of(const std::set<std::uint32_t>& members, std::uint32_t words) {
  std::vector<std::uint64_t> bits(words);
  for (const std::uint32_t d : members) bits[d / 64] |= std::uint64_t{1} << d % 64;
  return bits;
}

std::vector<std::uint32_t> list(const DescriptorSet& set) {
  std::vector<std::uint32_t> members;
  set.for_each([&](std::uint32_t d) { members.push_back(d); });
  return members;
}

RC_GTEST_PROP(DescriptorSet, HasExactlyItsMembers, ()) {
  const auto members =
      *rc::gen::container<std::set<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, 400));
  const std::vector<std::uint64_t> words = words_of(members, 7);
  const DescriptorSet set{words};
  RC_ASSERT(list(set) == std::vector<std::uint32_t>(members.begin(), members.end()));
  RC_ASSERT(set.empty() == members.empty());
  RC_ASSERT(set.lowest() == (members.empty() ? UINT32_MAX : *members.begin()));
  for (std::uint32_t k = 0; k < 9; ++k) RC_ASSERT(set.word(k) == (k < 7 ? words[k] : 0));
}

TEST(DescriptorSet, KeepsOnlyTheWordsBetweenItsFirstAndLastMember) {
  const DescriptorSet set{words_of({130, 200}, 8)};
  EXPECT_EQ(set.first_word(), 2U);
  EXPECT_EQ(set.end_word(), 4U);
  EXPECT_EQ(set.lowest(), 130U);
  EXPECT_EQ(list(set), (std::vector<std::uint32_t>{130, 200}));
}

TEST(DescriptorSet, AGapInTheMiddleIsKept) {
  const DescriptorSet set{words_of({0, 300}, 5)};
  EXPECT_EQ(set.first_word(), 0U);
  EXPECT_EQ(set.end_word(), 5U);
  EXPECT_EQ(set.word(2), 0U);
  EXPECT_EQ(list(set), (std::vector<std::uint32_t>{0, 300}));
}

TEST(DescriptorSet, TheEmptySetHasNoWords) {
  const DescriptorSet by_default;
  const DescriptorSet from_zeros{words_of({}, 3)};
  for (const DescriptorSet* set : {&by_default, &from_zeros}) {
    EXPECT_TRUE(set->empty());
    EXPECT_EQ(set->first_word(), set->end_word());
    EXPECT_EQ(set->word(0), 0U);
    EXPECT_TRUE(list(*set).empty());
  }
}

TEST(DescriptorSet, MovesWithItsWords) {
  DescriptorSet set{words_of({1, 65, 129}, 3)};
  const DescriptorSet moved = std::move(set);
  EXPECT_EQ(list(moved), (std::vector<std::uint32_t>{1, 65, 129}));
}

TEST(DescriptorSet, WordsAreCountedUp) {
  EXPECT_EQ(words_for(0), 0U);
  EXPECT_EQ(words_for(1), 1U);
  EXPECT_EQ(words_for(64), 1U);
  EXPECT_EQ(words_for(65), 2U);
}

}  // namespace descriptor_set_test
}  // namespace stormproof::model
