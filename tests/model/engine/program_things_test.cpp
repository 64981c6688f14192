// Every knob of every recorded program is one of the profile, but for what the deployment says; and
// every timer of a shipped profile has its events.
#include "model/engine/program_things.hpp"

#include <set>

#include <gtest/gtest.h>

#include "fsm/program/programs.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::model {
namespace program_things_test {

using fsm::program::Program;
using fsm::program::Thing;

/// A profile that has amendments, too.
DdsProfile amended() {
  DdsProfile dds;
  dds.amendments.emplace();
  return dds;
}

TEST(ProgramThings, EveryKnobHasAValue) {
  std::set<std::string_view> unknown;
  for (const Program& program : fsm::program::programs()) {
    for (const Thing& thing : program.things) {
      const bool is_knob = thing.kind == Thing::Kind::toggle || thing.kind == Thing::Kind::delay;
      if (is_knob && !knob_value(thing, amended())) unknown.insert(thing.name);
    }
  }
  EXPECT_EQ(unknown, (std::set<std::string_view>{"SendTime"}));
}

TEST(ProgramThings, AKnobIsThatOfItsCompositionWhateverItsName) {
  DdsProfile dds = amended();
  dds.sedp.nack_delay = Nanoseconds{7};
  dds.amendments->reader_nack_delay = Nanoseconds{9};
  const auto delay_in = [&](std::string_view name) {
    for (const Program& program : fsm::program::programs()) {
      if (program.name == name) return knob_value(program.things[program.find("NackDelay")], dds);
    }
    return std::optional<std::int64_t>{};
  };
  EXPECT_EQ(delay_in("cyclone"), 7);
  EXPECT_EQ(delay_in("paper-amended"), 9);
}

TEST(ProgramThings, TimersAreEvents) {
  const Program& fastdds = fsm::program::programs().at(1);
  const auto kind = [&](const char* name) {
    return event_kind(fastdds.things[fastdds.find(name)]);
  };
  EXPECT_EQ(kind("SuppressionEnd"), EventKind::suppression_end);
  EXPECT_EQ(kind("HeartbeatExpiry"), EventKind::heartbeat_expiry);
}

}  // namespace program_things_test
}  // namespace stormproof::model
