// The simulator against the table of test vectors of `implementation: cyclone`: completion time,
// every count, and the traffic that is counted apart, exactly.
#include "tests/vectors/cyclone_vectors.hpp"

#include <gtest/gtest.h>

#include "model/simulator.hpp"

namespace stormproof {
namespace cyclone_vectors_test {

vectors::Expected outcome(const model::RunResult& result) {
  const model::Counts& counts = result.counts;
  const auto number = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  return {result.discovery_time ? result.discovery_time->count() : -1,
          number(counts.initial_data),
          number(counts.repair_data),
          number(counts.heartbeat),
          number(counts.acknack),
          number(counts.spdp_multicast),
          number(counts.spdp_unicast)};
}

class CycloneVectors : public testing::TestWithParam<vectors::CycloneVector> {};

TEST_P(CycloneVectors, AgreeExactly) {
  const model::RunResult result = model::simulate(GetParam().scenario);
  EXPECT_EQ(outcome(result), GetParam().expected);
  EXPECT_EQ(static_cast<std::int64_t>(result.user_control), GetParam().user_control);
}

TEST_P(CycloneVectors, AreTheSameFromRunToRun) {
  const model::RunResult first = model::simulate(GetParam().scenario);
  const model::RunResult second = model::simulate(GetParam().scenario);
  EXPECT_EQ(outcome(first), outcome(second));
  EXPECT_EQ(first.user_control, second.user_control);
  EXPECT_EQ(first.events, second.events);
}

TEST_P(CycloneVectors, DeliverEveryDescriptor) {
  const model::RunResult result = model::simulate(GetParam().scenario);
  EXPECT_EQ(result.missing_count, 0U);
  EXPECT_TRUE(result.missing.empty());
}

INSTANTIATE_TEST_SUITE_P(All, CycloneVectors, testing::ValuesIn(vectors::cyclone_vectors()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace cyclone_vectors_test
}  // namespace stormproof
