// Every law can fail: each notices at least one simulator with a mistake, on random scenarios.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/props/laws/law_check.hpp"
#include "tests/props/laws/mistakes.hpp"

namespace stormproof::props {
namespace laws_fail_test {

const Law& law_called(std::string_view id) {
  const auto found = std::ranges::find(laws(), id, &Law::id);
  EXPECT_NE(found, laws().end()) << id;
  return *found;
}

TEST(Mistakes, ThereIsOneForEveryLaw) {
  const std::vector<Mistake> list = mistakes();
  for (const Law& law : laws()) {
    EXPECT_NE(std::ranges::find(list, law.id, &Mistake::law), list.end()) << law.id;
  }
}

TEST(Mistakes, AreNoticed) {
  for (const Mistake& mistake : mistakes()) {
    const auto broken = broken_on_random_scenarios(law_called(mistake.law), mistake.simulate,
                                                   {.scenarios = 200, .shrink = false});
    EXPECT_TRUE(broken) << mistake.law << " does not notice: " << mistake.what;
  }
}

/// Each law that says something about Cyclone DDS notices one of its mistakes there.
TEST(Mistakes, OfCycloneDdsAreNoticed) {
  constexpr auto cyclone = model::ImplementationKind::cyclone;
  for (const Law& law : laws_of(cyclone)) {
    const std::vector<Mistake> list = mistakes();
    EXPECT_TRUE(std::ranges::any_of(list, [&](const Mistake& mistake) {
      const Effort effort{.scenarios = 200, .shrink = false, .implementation = cyclone};
      return mistake.law == law.id && broken_on_random_scenarios(law, mistake.simulate, effort);
    })) << law.id;
  }
}

/// What RapidCheck shows of a broken law: the reason, and a small scenario file.
TEST(Mistakes, AreShownWithASmallScenario) {
  const Mistake mistake{"law.counts", "", [](const model::Scenario& scenario, model::Probe* probe) {
                          model::RunResult result = correct(scenario, probe);
                          ++result.counts.acknack;
                          return result;
                        }};
  const auto broken = broken_on_random_scenarios(law_called("law.counts"), mistake.simulate);
  ASSERT_TRUE(broken);
  EXPECT_NE(broken->find("acknack: "), std::string::npos) << *broken;
  EXPECT_NE(broken->find("participants"), std::string::npos) << *broken;
}

}  // namespace laws_fail_test
}  // namespace stormproof::props
