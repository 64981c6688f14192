// The transitions in a trace are steps of the machines: each is a row of its table, and each begins
// where the last one of the same machine ended.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace trace_machines_test {

using Json = nlohmann::ordered_json;

const fsm::MachineInfo* machine_named(const std::string& name) {
  static const std::vector<fsm::MachineInfo> machines = fsm::machines();
  const auto found =
      std::ranges::find_if(machines, [&](const auto& machine) { return machine.name == name; });
  return found == machines.end() ? nullptr : &*found;
}

bool is_row(const fsm::MachineInfo& machine, const Json& transition) {
  return std::ranges::any_of(machine.rows, [&](const fsm::RowInfo& row) {
    return machine.states[row.source] == transition["before"].get<std::string>() &&
           machine.events[row.event] == transition["event"].get<std::string>() &&
           machine.states[row.target] == transition["after"].get<std::string>();
  });
}

/// The subject of a transition as text: its own, or the one of its event.
std::string subject(const Json& event, const Json& transition) {
  for (const char* key : {"relation", "writer", "participant", "channel", "control_relation"}) {
    if (transition.contains(key)) return key + transition[key].dump();
  }
  for (const char* key : {"relation", "writer", "participant", "channel", "control_relation"}) {
    if (event.contains(key)) return key + event[key].dump();
  }
  return "none";
}

class States {
 public:
  /// Moves one machine; false if it was not in the state that the transition begins with.
  bool move(const std::string& key, const Json& transition) {
    const auto [found, is_new] = states_.emplace(key, transition["after"]);
    if (is_new) {
      const fsm::MachineInfo& machine = *machine_named(transition["machine"]);
      return transition["before"] == machine.states[machine.initial];
    }
    const bool fits = found->second == transition["before"].get<std::string>();
    found->second = transition["after"];
    return fits;
  }

 private:
  std::map<std::string, std::string> states_;
};

class TraceMachinesTest : public testing::TestWithParam<Case> {};

TEST_P(TraceMachinesTest, TransitionsAreRowsAndFollowEachOther) {
  States states;
  for (const Json& event : recorded(GetParam()).events) {
    for (const Json& transition : event.value("transitions", Json::array())) {
      const fsm::MachineInfo* machine = machine_named(transition["machine"]);
      ASSERT_NE(machine, nullptr) << transition;
      EXPECT_TRUE(is_row(*machine, transition)) << event["n"] << ": " << transition;
      const std::string key = transition["machine"].get<std::string>() + subject(event, transition);
      // A relation has several timers of this kind, which have no name in the trace.
      if (machine->name == "SingleShot") continue;
      if (!transition.contains("descriptors")) {
        EXPECT_TRUE(states.move(key, transition)) << event["n"] << ": " << transition;
        continue;
      }
      for (const Json& descriptor : transition["descriptors"]) {
        EXPECT_TRUE(states.move(key + descriptor.dump(), transition))
            << event["n"] << ": " << transition;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, TraceMachinesTest, testing::ValuesIn(trace_cases()), CaseName{});

}  // namespace trace_machines_test
}  // namespace stormproof::model::trace
