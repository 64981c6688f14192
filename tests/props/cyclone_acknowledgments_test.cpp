// safety.ack-implies-received in runs of Cyclone DDS: correct ones keep it, and a writer that takes
// a reader's first ACKNACK for a reply, or any ACKNACK, is noticed.
#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "model/mutation.hpp"
#include "model/simulator.hpp"
#include "props/generators/space.hpp"
#include "props/monitor.hpp"

namespace stormproof::props {
namespace cyclone_acknowledgments_test {

constexpr std::uint64_t draws = 40;
constexpr std::uint64_t enough_events = 20'000;

/// In how many random runs with these mistakes the property is violated, and what was looked at.
struct Seen {
  int violated = 0;
  int looked = 0;
};
Seen look(const model::Mutation* mistakes) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= draws; ++seed) {
    const model::Scenario scenario =
        draw_scenario(seed, 50, {.implementation = model::ImplementationKind::cyclone});
    const auto monitor = make_monitor("safety.ack-implies-received", scenario);
    model::RunOptions options;
    options.probe = monitor.get();
    options.mutation = mistakes;
    options.max_events = enough_events;
    (void)model::simulate(scenario, options);
    seen.violated += monitor->violation() ? 1 : 0;
    seen.looked += monitor->remarks().front().starts_with("0 ") ? 0 : 1;
  }
  return seen;
}

TEST(CycloneAcknowledgments, AreTrueInCorrectRuns) {
  const Seen seen = look(nullptr);
  EXPECT_EQ(seen.violated, 0);
  EXPECT_GT(seen.looked, 20);
}

TEST(CycloneAcknowledgments, OfAReaderThatHasNotRepliedAreNoticed) {
  model::Mutation mistakes;
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    if (machine.name != "MatchedReader") continue;
    for (std::size_t row = 0; row < machine.rows.size(); ++row) {
      const fsm::RowInfo& info = machine.rows[row];
      if (info.source == info.target || machine.states[info.target] != "Replied") continue;
      mistakes.tables.push_back({"MatchedReader", row, fsm::TableMutation::Kind::ignore_guard});
    }
  }
  ASSERT_EQ(mistakes.tables.size(), 1U);
  EXPECT_GT(look(&mistakes).violated, 0);
}

}  // namespace cyclone_acknowledgments_test
}  // namespace stormproof::props
