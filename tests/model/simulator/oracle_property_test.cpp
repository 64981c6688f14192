// The simulator against the oracles as a property of all scenarios: a difference shrinks to the
// smallest scenario that shows it and is printed as a file that `simulate` accepts.
#include <sstream>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>

#include "model/implementations.hpp"
#include "props/generators/scenarios.hpp"
#include "tests/oracle/comparison.hpp"

namespace stormproof {
namespace oracle_property_test {

/// The text that RapidCheck prints when the property fails, or nothing. The seed is fixed.
template <class Property>
std::string failure_of(Property property, int scenarios) {
  rc::detail::TestParams params;
  params.seed = 20'240'117;
  params.maxSuccess = scenarios;
  rc::detail::TestListenerAdapter quiet;
  const auto result =
      rc::detail::checkTestable(property, rc::detail::TestMetadata{}, params, quiet);
  if (result.template is<rc::detail::SuccessResult>()) return "";
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  return text.str();
}

props::ScenarioSpace space(model::ImplementationKind implementation) {
  props::ScenarioSpace space;
  space.implementation = implementation;
  space.max_participants = 5;
  space.max_time_limit = model::Nanoseconds{5'000'000'000};
  return space;
}

class OracleProperty : public testing::TestWithParam<model::ImplementationKind> {};

TEST_P(OracleProperty, ProductAndOracleAgreeOnEveryScenario) {
  const auto scenarios = props::scenarios(space(GetParam()));
  EXPECT_EQ(failure_of(
                [&] {
                  const model::Scenario scenario = *scenarios;
                  const auto found = oracle::difference(scenario);
                  if (found) RC_FAIL(*found);
                },
                100),
            "");
}

TEST_P(OracleProperty, ADifferenceShrinksToASmallScenarioFile) {
  model::EventMutation late;
  late.kind = GetParam() == model::ImplementationKind::cyclone
                  ? model::EventKind::ack_time
                  : model::EventKind::acknack_generation;
  late.change = model::EventMutation::Change::shift;
  late.by = model::Nanoseconds{1};
  model::Mutation mistake;
  mistake.events.push_back(late);
  const auto scenarios = props::scenarios(space(GetParam()));
  const std::string text = failure_of(
      [&] {
        const model::Scenario scenario = *scenarios;
        const auto expected = oracle::observe_oracle(scenario, oracle::most_compared_events);
        const auto wrong =
            oracle::observe_product(scenario, &mistake, oracle::most_compared_events);
        const auto found = oracle::first_difference(wrong, expected);
        if (found) RC_FAIL(*found);
      },
      100);
  if (GetParam() != model::ImplementationKind::cyclone) {
    EXPECT_NE(text.find("ACKNACK"), std::string::npos) << text;
  }
  EXPECT_NE(text.find("participants:"), std::string::npos) << text;
  EXPECT_LT(text.size(), 6'000U) << text;
}

INSTANTIATE_TEST_SUITE_P(Implementations, OracleProperty, testing::ValuesIn(model::implementations),
                         [](const auto& test) {
                           return std::string{model::traits_of(test.param).name};
                         });

}  // namespace oracle_property_test
}  // namespace stormproof
