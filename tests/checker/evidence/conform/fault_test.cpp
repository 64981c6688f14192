// Each kind of fault is found: a simulated capture that conforms is changed in one place, and then
// exactly this fault is reported first, at exactly this event, with what it would need.
#include <set>

#include <gtest/gtest.h>

#include "tests/checker/evidence/conform/captures.hpp"
#include "tests/checker/evidence/conform/fault_cases.hpp"

namespace stormproof::conform::testing {
namespace fault_test {

class FoundFault : public ::testing::TestWithParam<Case> {};

TEST_P(FoundFault, IsReportedAtItsEvent) {
  const Case& one = GetParam();
  const model::Scenario scenario = one.has_server
                                       ? served(model::Discovery::server, one.lost_packets)
                                       : quiet(one.participants, one.lost_packets);
  Simulated run = simulated(scenario);
  Bounds bounds = exact_bounds(scenario, run);
  if (one.lost_packets.empty()) bounds.most_delay_ns = 2'000'000;
  bounds.may_lose = one.may_lose;
  const Conformance correct = conformance(run.conversation, scenario.dds, bounds);
  ASSERT_TRUE(is_explained(correct)) << description(correct);

  const std::size_t event = one.change(run.conversation);
  const Conformance changed = conformance(run.conversation, scenario.dds, bounds);
  ASSERT_EQ(changed.verdict, Verdict::does_not_conform) << description(changed);
  const Unexplained& first = changed.unexplained.front();
  EXPECT_EQ(name_of(first.fault), name_of(one.fault)) << description(changed);
  EXPECT_EQ(first.event, event) << description(changed);
  EXPECT_EQ(first.needs.empty() ? "" : first.needs.front().what, one.need) << description(changed);
  EXPECT_TRUE(std::is_sorted(first.context.begin(), first.context.end()));
  EXPECT_EQ(std::count(first.context.begin(), first.context.end(), event), 1);
  EXPECT_FALSE(first.what.empty());
  EXPECT_FALSE(first.nearest.empty());
}

INSTANTIATE_TEST_SUITE_P(Case, FoundFault, ::testing::ValuesIn(all_cases()), [](const auto& one) {
  return std::string{name_of(one.param.fault)} + "_" + one.param.name;
});

TEST(FoundFaults, CoverAllKinds) {
  // Simulated captures do not say what is asked about types; type_lookups_test.cpp edits a real
  // one.
  std::set<Fault> covered{Fault::lookup_cause};
  for (const Case& one : all_cases()) covered.insert(one.fault);
  for (std::size_t k = 0; k < fault_count; ++k) {
    EXPECT_TRUE(covered.contains(static_cast<Fault>(k))) << name_of(static_cast<Fault>(k));
  }
}

}  // namespace fault_test
}  // namespace stormproof::conform::testing
