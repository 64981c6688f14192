// The simulator against the table of test vectors: completion time and every count, exactly; and
// the open-loop baseline.
#include <gtest/gtest.h>

#include "model/reference.hpp"
#include "model/simulator.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof {
namespace vectors_test {

vectors::Expected run(const model::Scenario& scenario) {
  const model::RunResult result = model::simulate(scenario);
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

class PaperVectors : public testing::TestWithParam<vectors::Vector> {};

TEST_P(PaperVectors, AgreeExactly) { EXPECT_EQ(run(GetParam().scenario), GetParam().expected); }

TEST_P(PaperVectors, AreTheSameFromRunToRun) {
  EXPECT_EQ(run(GetParam().scenario), run(GetParam().scenario));
}

INSTANTIATE_TEST_SUITE_P(All, PaperVectors, testing::ValuesIn(vectors::paper_vectors()),
                         [](const auto& tested) { return tested.param.name; });

class OpenLoopVectors : public testing::TestWithParam<vectors::OpenLoopVector> {};

TEST_P(OpenLoopVectors, AgreeExactly) {
  const auto airtime = model::open_loop_airtime(GetParam().scenario);
  ASSERT_TRUE(airtime);
  EXPECT_EQ(airtime->count(), GetParam().airtime_ns);
}

INSTANTIATE_TEST_SUITE_P(All, OpenLoopVectors, testing::ValuesIn(vectors::open_loop_vectors()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace vectors_test
}  // namespace stormproof
