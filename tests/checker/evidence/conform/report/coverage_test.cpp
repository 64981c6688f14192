// Rows that a profile rules out are told apart from rows that a capture just did not exercise.
#include "checker/evidence/conform/report/coverage.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "tests/checker/evidence/conform/report/results.hpp"

namespace stormproof::conform {

namespace coverage_test {

using namespace testing;

std::size_t count_ruled_out(std::string_view machine, const model::DdsProfile& dds) {
  const auto reasons = ruled_out(machine, dds);
  return static_cast<std::size_t>(
      std::ranges::count_if(reasons, [](const std::string& reason) { return !reason.empty(); }));
}

fsm::MachineInfo machine(std::string_view name) {
  for (const fsm::MachineInfo& info : fsm::machines()) {
    if (info.name == name) return info;
  }
  ADD_FAILURE() << name;
  return {};
}

/// Whether the row starts or ends in one of the states.
bool touches(const fsm::MachineInfo& info, const fsm::RowInfo& row,
             const std::vector<std::string_view>& states) {
  return std::ranges::any_of(states, [&](std::string_view state) {
    return info.states[row.source] == state || info.states[row.target] == state;
  });
}

TEST(Coverage, ThePeriodicPolicyRulesOutTheCyclesOfTheAdaptiveOne) {
  const fsm::MachineInfo info = machine("HeartbeatTimer");
  const auto reasons = ruled_out("HeartbeatTimer", fastdds());
  ASSERT_EQ(reasons.size(), info.rows.size());
  for (std::size_t k = 0; k < reasons.size(); ++k) {
    const bool is_adaptive = touches(info, info.rows[k], {"Pacing", "Awaiting"});
    const bool is_additive = info.rows[k].guard == "Additive";
    EXPECT_EQ(reasons[k], is_adaptive   ? "sedp.heartbeat_policy: periodic"
                          : is_additive ? "implementation: fastdds"
                                        : "")
        << k;
  }
}

TEST(Coverage, TheAdaptivePolicyRulesOutTheArmedTimer) {
  model::DdsProfile dds = fastdds();
  dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  const fsm::MachineInfo info = machine("HeartbeatTimer");
  const auto reasons = ruled_out("HeartbeatTimer", dds);
  for (std::size_t k = 0; k < reasons.size(); ++k) {
    EXPECT_EQ(reasons[k].empty(), !touches(info, info.rows[k], {"Armed"})) << k;
  }
}

TEST(Coverage, KnobsDecideOverInitialAckNacksAndUnmatchedMessages) {
  model::DdsProfile dds = fastdds();
  EXPECT_EQ(count_ruled_out("InitialAckNack", dds), 1U);
  dds.sedp.initial_acknack_delay = model::Nanoseconds{0};
  EXPECT_EQ(count_ruled_out("InitialAckNack", dds), 3U);
  EXPECT_GT(count_ruled_out("DiscoveryReader", dds), 0U);
  dds.implementation = model::ImplementationKind::paper;
  dds.sedp.unmatched = model::Unmatched::accept;
  EXPECT_EQ(count_ruled_out("DiscoveryReader", dds), 0U);
}

TEST(Coverage, MachinesWithoutKnobsRuleOutNothing) {
  EXPECT_EQ(count_ruled_out("ChangeForReader", fastdds()), 0U);
  EXPECT_EQ(count_ruled_out("SingleShot", fastdds()), 0U);
  EXPECT_TRUE(ruled_out("no such machine", fastdds()).empty());
}

TEST(Coverage, ARowThatFiredIsNeverRuledOut) {
  Conformance result = conforming();
  auto machines = coverage_of(result.rows, fastdds());
  ASSERT_EQ(machines.size(), 1U);
  EXPECT_EQ(machines[0].used, 2U);
  EXPECT_EQ(machines[0].ruled_out, 1U);
  EXPECT_EQ(machines[0].rows[1].ruled_out_by, "sedp.initial_acknack_delay above 0");
  EXPECT_EQ(machines[0].rows[2].ruled_out_by, "");
  result.rows[1].times = 1;
  machines = coverage_of(result.rows, fastdds());
  EXPECT_EQ(machines[0].used, 3U);
  EXPECT_EQ(machines[0].ruled_out, 0U);
}

}  // namespace coverage_test
}  // namespace stormproof::conform
