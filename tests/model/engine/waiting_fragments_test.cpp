// The choice of the next fragment against its definition: the least (request time, stage rank,
// request number), for all orders of the wireless profile and any interleaving of requests and
// services.
#include "model/engine/waiting_fragments.hpp"

#include <map>
#include <tuple>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model {
namespace waiting_fragments_test {

/// The ranks of three stages, as the orders assign them: fifo_uplink, fifo_downlink, fifo.
const std::vector<std::vector<int>> ranks_by_order{{0, 1, 2}, {0, -1, -2}, {0, 0, 0}};

struct Step {
  bool pop = false;
  std::int64_t wait = 0;  ///< time since the last request
  std::uint32_t stage = 0;
};

void showValue(const Step& step, std::ostream& out) {
  if (step.pop)
    out << "pop";
  else
    out << "after " << step.wait << " stage " << step.stage;
}

RC_GTEST_PROP(WaitingFragments, ServesTheLeastOfTimeRankAndNumber, ()) {
  const auto ranks = *rc::gen::elementOf(ranks_by_order);
  WaitingFragments waiting;
  for (std::uint32_t k = 0; k < ranks.size(); ++k) RC_ASSERT(waiting.add_stage(ranks[k]) == k);
  std::map<std::tuple<std::int64_t, int, std::uint64_t>, std::uint32_t> reference;
  std::int64_t now = 0;
  std::uint64_t number = 0;
  const auto step = rc::gen::construct<Step>(
      rc::gen::map(rc::gen::inRange(0, 3), [](int k) { return k == 0; }),
      rc::gen::inRange<std::int64_t>(0, 2), rc::gen::inRange<std::uint32_t>(0, 3));
  auto steps = *rc::gen::container<std::vector<Step>>(step);
  steps.insert(steps.end(), steps.size(), Step{true, 0, 0});
  for (const Step& s : steps) {
    if (!s.pop) {
      now += s.wait;
      waiting.push(s.stage, {Nanoseconds{now}, number, static_cast<std::uint32_t>(number), 0});
      reference[{now, ranks[s.stage], number++}] = s.stage;
    } else if (!reference.empty()) {
      const auto [key, stage] = *reference.begin();
      reference.erase(reference.begin());
      ServiceRequest chosen;
      RC_ASSERT(waiting.pop(chosen) == stage);
      RC_ASSERT(chosen.number == std::get<2>(key));
    }
    RC_ASSERT(waiting.size() == reference.size());
    RC_ASSERT(waiting.empty() == reference.empty());
  }
}

std::uint32_t pop(WaitingFragments& waiting) {
  ServiceRequest chosen;
  return waiting.pop(chosen);
}

TEST(WaitingFragments, AtTheSameInstantTheRankDecidesBeforeTheNumber) {
  for (const int downlink : {1, -1}) {
    WaitingFragments waiting;
    const std::uint32_t up = waiting.add_stage(0);
    const std::uint32_t down = waiting.add_stage(downlink);
    waiting.push(down, {Nanoseconds{4}, 0, 0, 0});
    waiting.push(up, {Nanoseconds{4}, 1, 0, 1});
    EXPECT_EQ(pop(waiting), downlink > 0 ? up : down);
  }
}

TEST(WaitingFragments, AnEarlierRequestComesBeforeAnyRank) {
  WaitingFragments waiting;
  const std::uint32_t up = waiting.add_stage(0);
  const std::uint32_t down = waiting.add_stage(1);
  waiting.push(down, {Nanoseconds{3}, 0, 0, 0});
  waiting.push(up, {Nanoseconds{4}, 1, 0, 0});
  EXPECT_EQ(pop(waiting), down);
}

TEST(WaitingFragments, WithEqualRanksTheNumberDecides) {
  WaitingFragments waiting;
  const std::uint32_t up = waiting.add_stage(0);
  const std::uint32_t down = waiting.add_stage(0);
  waiting.push(down, {Nanoseconds{4}, 7, 0, 0});
  waiting.push(up, {Nanoseconds{4}, 8, 0, 0});
  EXPECT_EQ(pop(waiting), down);
  EXPECT_EQ(pop(waiting), up);
}

}  // namespace waiting_fragments_test
}  // namespace stormproof::model
