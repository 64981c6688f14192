// The machines as data: names, initial states, and the guards in words, as documents and proofs
// will show them.
#include "fsm/reflect.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fsm/machines.hpp"

namespace stormproof::fsm {
namespace reflect_test {

using Names = std::vector<std::string_view>;

MachineInfo machine(std::string_view name) {
  for (MachineInfo& info : machines()) {
    if (info.name == name) return info;
  }
  ADD_FAILURE() << "no machine " << name;
  return {};
}

/// "source, event, target, guard, action" of each row, in table order.
std::vector<std::string> rows(const MachineInfo& info) {
  std::vector<std::string> lines;
  for (const RowInfo& row : info.rows) {
    lines.push_back(std::string{info.states[row.source]} + " + " +
                    std::string{info.events[row.event]} + " -> " +
                    std::string{info.states[row.target]} + " [" + row.guard + "] / " +
                    std::string{row.action});
  }
  return lines;
}

TEST(Reflect, ListsTheMachinesInTheOrderOfTheDocuments) {
  Names names;
  for (const MachineInfo& info : machines()) names.push_back(info.name);
  EXPECT_EQ(names, (Names{"DescriptorRepair", "DiscoveryReader", "HeartbeatTimer", "InitialAckNack",
                          "Announcer", "Channel", "ChangeForReader", "SingleShot", "ControlWriter",
                          "ControlReader", "CautiousReader", "MatchedReader", "HeartbeatPacer",
                          "EventThread", "MovableTimer", "ReopeningRepair"}));
}

TEST(Reflect, StatesComeInTheOrderOfMsm) {
  EXPECT_EQ(machine("DescriptorRepair").states, (Names{"U", "R", "Q", "S", "A"}));
  EXPECT_EQ(machine("DiscoveryReader").states,
            (Names{"Unknown", "EarlyComplete", "Recognised", "Complete"}));
  EXPECT_EQ(machine("HeartbeatTimer").states, (Names{"Idle", "Armed", "Pacing", "Awaiting"}));
  EXPECT_EQ(machine("InitialAckNack").states, (Names{"Dormant", "Waiting", "Done"}));
  EXPECT_EQ(machine("Announcer").states, (Names{"Starting", "Periodic"}));
  EXPECT_EQ(machine("Channel").states, (Names{"Idle", "Busy"}));
}

TEST(Reflect, EventsComeInOrderOfAppearance) {
  EXPECT_EQ(machine("DescriptorRepair").events,
            (Names{"AckNackReceived", "RepairDue", "RepairSent", "SuppressionEnded"}));
  EXPECT_EQ(machine("DiscoveryReader").events,
            (Names{"AnnouncementReceived", "DataReceived", "HeartbeatReceived", "AckNackDue",
                   "InitialAckNackDue"}));
  EXPECT_EQ(machine("HeartbeatTimer").events,
            (Names{"ArmRequested", "SuppressionEnded", "Expired", "CycleStarted", "CycleEnded",
                   "BatchDue", "ResponseReceived"}));
  EXPECT_EQ(machine("InitialAckNack").events, (Names{"ReaderOpened", "AttemptDue"}));
  EXPECT_EQ(machine("Announcer").events, (Names{"AnnouncementDue"}));
  EXPECT_EQ(machine("Channel").events,
            (Names{"ServiceRequested", "DispatchDue", "ServiceFinished", "EffectsDone"}));
}

TEST(Reflect, TheInitialStateComesFirstInEveryMachine) {
  for (const MachineInfo& info : machines()) EXPECT_EQ(info.initial, 0) << info.name;
}

TEST(Reflect, RowsSayWhatTheTableOfTheChannelSays) {
  EXPECT_EQ(
      rows(machine("Channel")),
      (std::vector<std::string>{
          "Idle + ServiceRequested -> Idle [not DispatchPending] / ScheduleDispatch",
          "Idle + DispatchDue -> Busy [Waiting] / Serve",
          "Busy + ServiceFinished -> Idle [none] / none",
          "Idle + EffectsDone -> Idle [Waiting and not DispatchPending] / ScheduleDispatch"}));
}

TEST(Reflect, RowsSayWhatTheTableOfTheRepairStatesSays) {
  const std::vector<std::string> lines = rows(machine("DescriptorRepair"));
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[0], "U + AckNackReceived -> R [Listed] / Request");
  EXPECT_EQ(lines[2], "Q + RepairSent -> S [none] / none");
  EXPECT_EQ(lines[7], "S + AckNackReceived -> A [Confirmed] / none");
}

TEST(Reflect, NestedGuardsAreSpelledOut) {
  const std::vector<std::string> timer = rows(machine("HeartbeatTimer"));
  ASSERT_EQ(timer.size(), 17U);
  EXPECT_EQ(timer[5], "Armed + Expired -> Idle [not Unacknowledged and LastPending] / none");
  const std::vector<std::string> reader = rows(machine("DiscoveryReader"));
  ASSERT_EQ(reader.size(), 16U);
  EXPECT_EQ(
      reader[2],
      "Unknown + DataReceived -> Unknown [AcceptsUnmatched and not NothingMissing] / TakeData");
}

TEST(Reflect, NumbersAreWithinRangeAndNamesUnique) {
  for (const MachineInfo& info : machines()) {
    Names names = info.states;
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << info.name;
    for (const RowInfo& row : info.rows) {
      EXPECT_LT(row.source, info.states.size());
      EXPECT_LT(row.target, info.states.size());
      EXPECT_LT(row.event, info.events.size());
    }
  }
}

}  // namespace reflect_test
}  // namespace stormproof::fsm
