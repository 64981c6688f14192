// Stateful tests of the engine: after any sequence of calls the event queue, the source queue and
// the network show what a naive model of their rules shows, and every model with a deliberate
// mistake is told apart.
#include <gtest/gtest.h>

#include "tests/fsm/stateful/law.hpp"
#include "tests/model/stateful/engine_subject.hpp"

namespace stormproof::model::stateful {

void PrintTo(const EngineSubject& subject, std::ostream* out) { *out << subject.name; }

namespace stateful_engine_test {

std::vector<EngineSubject> all_subjects() {
  std::vector<EngineSubject> all = queue_subjects();
  for (EngineSubject& subject : network_subjects()) all.push_back(std::move(subject));
  return all;
}

class StatefulEngine : public testing::TestWithParam<EngineSubject> {};

TEST_P(StatefulEngine, DoesWhatTheRulesSay) {
  const EngineSubject& subject = GetParam();
  const auto broken = broken_on(subject, subject.under_test, {.sequences = 1'000, .longest = 100});
  EXPECT_FALSE(broken.has_value()) << broken.value_or("");
}

TEST_P(StatefulEngine, IsToldFromEveryWrongModel) {
  const EngineSubject& subject = GetParam();
  for (const Wrong wrong : subject.wrongs) {
    Subject mistaken = subject;
    mistaken.model = [&subject, wrong] { return subject.wrong_model(wrong); };
    const auto broken = broken_on(mistaken, subject.under_test,
                                  {.sequences = 200, .longest = 100, .shrink = false});
    EXPECT_TRUE(broken.has_value()) << "mistake " << static_cast<int>(wrong);
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, StatefulEngine, testing::ValuesIn(all_subjects()),
                         [](const auto& test) { return test.param.name; });

}  // namespace stateful_engine_test
}  // namespace stormproof::model::stateful
