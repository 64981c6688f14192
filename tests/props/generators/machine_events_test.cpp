// Event sequences reach every state of a machine, print readably, and shrink to the events that
// matter.
#include "props/generators/machine_events.hpp"

#include <set>
#include <sstream>
#include <type_traits>

#include <gtest/gtest.h>

#include "fsm/descriptor_repair.hpp"
#include "fsm/heartbeat_timer.hpp"

namespace stormproof::props {
namespace machine_events_test {

/// States that the sequence visits.
template <class Machine>
std::set<fsm::StateId> visited(const std::vector<MachineEvent<Machine>>& events) {
  fsm::Flyweight<Machine> machine;
  fsm::StateId state = fsm::Flyweight<Machine>::initial;
  std::set<fsm::StateId> states{state};
  for (const MachineEvent<Machine>& event : events) {
    typename fsm::Flyweight<Machine>::Output output{};
    state = step(machine, state, event, output);
    states.insert(state);
  }
  return states;
}

template <class Machine>
class MachineEventsTest : public testing::Test {};
using Machines = testing::Types<fsm::DescriptorRepair, fsm::HeartbeatTimer>;
TYPED_TEST_SUITE(MachineEventsTest, Machines);

TYPED_TEST(MachineEventsTest, ReachEveryState) {
  const auto sequences = machine_events<TypeParam>();
  std::set<fsm::StateId> states;
  std::set<std::uint8_t> events;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto sequence = sequences(rc::Random{seed}, 100).value();
    states.merge(visited<TypeParam>(sequence));
    for (const auto& event : sequence) events.insert(event.event);
  }
  EXPECT_EQ(states.size(), fsm::Reflect<TypeParam>::state_count);
  EXPECT_EQ(events.size(), fsm::Reflect<TypeParam>::Events::size);
}

TYPED_TEST(MachineEventsTest, InputsVary) {
  const auto sequences = machine_events<TypeParam>();
  std::set<std::string> shown;
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const auto& event : sequences(rc::Random{seed}, 100).value()) {
      std::ostringstream text;
      showValue(event, text);
      shown.insert(text.str());
      ++count;
    }
  }
  EXPECT_GT(count, 200U);
  EXPECT_GE(shown.size(), std::min<std::size_t>(32, count / 4));
}

TEST(MachineEvents, ShrinkToTheShortestPath) {
  using Machine = fsm::DescriptorRepair;
  using S = fsm::descriptor_repair::S;
  const auto fails = [](const auto& events) {
    return visited<Machine>(events).contains(fsm::Reflect<Machine>::id<S>);
  };
  const auto sequences = machine_events<Machine>();
  int found = 0;
  for (std::uint64_t seed = 0; found < 5; ++seed) {
    ASSERT_LT(seed, 1'000U);
    auto shrinkable = sequences(rc::Random{seed}, 100);
    if (!fails(shrinkable.value())) continue;
    ++found;
    for (bool is_shrinking = true; is_shrinking;) {
      is_shrinking = false;
      auto simpler = shrinkable.shrinks();
      while (auto next = simpler.next()) {
        if (!fails(next->value())) continue;
        shrinkable = *next;
        is_shrinking = true;
        break;
      }
    }
    std::ostringstream text;
    for (const auto& event : shrinkable.value()) showValue(event, text), text << ' ';
    EXPECT_EQ(text.str(),
              "AckNackReceived(true, false, false) RepairDue(false, false, false) "
              "RepairSent(false, false, false) ");
  }
}

TEST(MachineEvents, CyclesAreLegal) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (const auto& event : machine_events<fsm::HeartbeatTimer>()(rc::Random{seed}, 100).value()) {
      const auto& cycle = event.input.cycle;
      EXPECT_GE(cycle.contacted, std::max<std::int64_t>(1, cycle.responded));
      EXPECT_LE(cycle.min_period, cycle.period);
      EXPECT_LE(cycle.period, cycle.max_period);
      EXPECT_GE(cycle.epsilon_den, cycle.epsilon_num);
      EXPECT_GE(fsm::stretched_period<fsm::Plain>(cycle), cycle.period);
    }
  }
}

}  // namespace machine_events_test
}  // namespace stormproof::props
