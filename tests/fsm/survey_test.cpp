// Questions about every machine alike, answered from the surveys: never two rows at once (Boost.MSM
// would take the last one, so the order of rows would matter), every state and row is of use, every
// guard is needed, the reflected rows describe what Boost.MSM really does, and one object of it
// does for many machines what an object of its own does.
#include "tests/fsm/survey.hpp"

#include <gtest/gtest.h>

#include "fsm/machines.hpp"

namespace stormproof::fsm {
namespace survey_test {

const std::vector<MachineSurvey>& surveys() {
  static const std::vector<MachineSurvey> all = all_surveys();
  return all;
}

std::string describe(const MachineSurvey& survey, const PairSurvey& pair) {
  return std::string{survey.info.name} + ": " + std::string{survey.info.states[pair.state]} +
         " on " + std::string{survey.info.events[pair.event]};
}

TEST(Surveys, CoverEveryMachine) {
  const std::vector<MachineInfo> listed = machines();
  ASSERT_EQ(surveys().size(), listed.size());
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const MachineSurvey& survey = surveys()[k];
    EXPECT_EQ(survey.info.name, listed[k].name);
    EXPECT_EQ(survey.pairs.size(), listed[k].states.size() * listed[k].events.size());
    for (const PairSurvey& pair : survey.pairs)
      EXPECT_GT(pair.inputs, 1U) << describe(survey, pair);
  }
}

TEST(Surveys, NeverTwoRowsAreEnabledAtOnce) {
  for (const MachineSurvey& survey : surveys()) {
    for (const PairSurvey& pair : survey.pairs) {
      EXPECT_EQ(pair.several_enabled, 0U) << describe(survey, pair);
    }
  }
}

TEST(Surveys, MsmDoesWhatTheReflectedRowsSay) {
  for (const MachineSurvey& survey : surveys()) {
    for (const PairSurvey& pair : survey.pairs) {
      EXPECT_EQ(pair.disagreements, 0U) << describe(survey, pair);
    }
  }
}

TEST(Surveys, TheInterpretedTableDoesWhatMsmDoes) {
  for (const MachineSurvey& survey : surveys()) {
    for (const PairSurvey& pair : survey.pairs) {
      EXPECT_EQ(pair.interpreted_otherwise, 0U) << describe(survey, pair);
    }
  }
}

TEST(Surveys, FlyweightsEqualObjectsOfTheirOwn) {
  for (const MachineSurvey& survey : surveys()) {
    EXPECT_TRUE(rc::check(std::string{survey.info.name}, survey.flyweight_law));
  }
}

TEST(Surveys, EveryStateIsReachableFromTheInitialOne) {
  for (const MachineSurvey& survey : surveys()) {
    EXPECT_EQ(survey.reached.size(), survey.info.states.size()) << survey.info.name;
  }
}

TEST(Surveys, EveryRowFiresAndEveryGuardCanBeFalse) {
  for (const MachineSurvey& survey : surveys()) {
    for (std::size_t row = 0; row < survey.info.rows.size(); ++row) {
      const RowInfo& info = survey.info.rows[row];
      EXPECT_GT(survey.enabled_by_row[row], 0U) << survey.info.name << ", row " << row;
      EXPECT_EQ(survey.rejected_by_row[row] > 0, info.guard != "none")
          << survey.info.name << ", row " << row << ", guard " << info.guard;
    }
  }
}

TEST(Surveys, StateNumbersAreThoseOfMsm) {
  for (const MachineSurvey& survey : surveys()) {
    ASSERT_EQ(survey.msm_ids.size(), survey.info.states.size());
    for (std::size_t state = 0; state < survey.msm_ids.size(); ++state) {
      EXPECT_EQ(survey.msm_ids[state], static_cast<int>(state))
          << survey.info.name << ": " << survey.info.states[state];
    }
  }
}

}  // namespace survey_test
}  // namespace stormproof::fsm
