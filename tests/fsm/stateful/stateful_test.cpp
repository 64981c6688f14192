// Stateful tests of every machine: after any sequence of possible events the machine shows what the
// rules in plain code show. And every mistake in a row of a table is noticed that changes anything:
// a test that a wrong table passes tests nothing.
#include <algorithm>
#include <iostream>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "tests/fsm/stateful/law.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

void PrintTo(const MachineSubject& subject, std::ostream* out) { *out << subject.name; }

namespace stateful_test {

using Kind = TableMutation::Kind;

std::vector<MachineSubject> all_subjects() {
  std::vector<MachineSubject> all;
  for (auto* list : {repair_subjects, reader_subjects, timer_subjects, channel_subjects,
                     thread_subjects, pacer_subjects}) {
    for (MachineSubject& subject : list()) all.push_back(std::move(subject));
  }
  return all;
}

TEST(StatefulSubjects, CoverEveryMachine) {
  std::set<std::string> covered;
  for (const MachineSubject& subject : all_subjects()) covered.insert(subject.machine);
  for (const MachineInfo& machine : machines()) {
    EXPECT_TRUE(covered.contains(std::string{machine.name})) << machine.name;
  }
}

std::optional<std::string> broken_on(const MachineSubject& subject, Mutations mutations,
                                     const Effort& effort) {
  return stormproof::stateful::broken_on(
      subject, [&] { return subject.under_test(mutations); }, effort);
}

class Stateful : public testing::TestWithParam<MachineSubject> {};

TEST_P(Stateful, DoesWhatTheRulesSay) {
  const auto broken = broken_on(GetParam(), {}, {.sequences = 400, .longest = 100});
  EXPECT_FALSE(broken.has_value()) << broken.value_or("");
}

INSTANTIATE_TEST_SUITE_P(Machines, Stateful, testing::ValuesIn(all_subjects()),
                         [](const auto& test) { return test.param.name; });

/// A mutation in words: "R + RepairDue -> Q: missing".
std::string in_words(const MachineInfo& machine, const TableMutation& m) {
  const RowInfo& row = machine.rows[m.row];
  const auto state = [&](StateId id) { return std::string{machine.states[id]}; };
  const auto how = [&]() -> std::string {
    switch (m.kind) {
      case Kind::drop_row:
        return "missing";
      case Kind::retarget:
        return "leads to " + state(m.target);
      case Kind::negate_guard:
        return "guard negated";
      case Kind::ignore_guard:
        return "guard ignored";
      case Kind::drop_action:
        return "action missing";
      case Kind::copy_row:
        break;
    }
    return "copied to " + state(m.source);
  };
  const std::string guard = row.guard == "none" ? "" : " [" + row.guard + "]";
  return std::string{machine.name} + ": " + state(row.source) + " + " +
         std::string{machine.events[row.event]} + guard + " -> " + state(row.target) + ": " + how();
}

/// Every mistake in one row: it is missing, leads elsewhere, its guard is negated or ignored, its
/// action is missing.
std::vector<TableMutation> mistakes(const MachineInfo& machine) {
  std::vector<TableMutation> list;
  for (std::size_t k = 0; k < machine.rows.size(); ++k) {
    const RowInfo& row = machine.rows[k];
    const auto add = [&](Kind kind, StateId target = 0) {
      list.push_back({std::string{machine.name}, k, kind, 0, target});
    };
    add(Kind::drop_row);
    add(Kind::negate_guard);
    if (row.guard != "none") add(Kind::ignore_guard);
    if (row.action != "none") add(Kind::drop_action);
    for (StateId target = 0; target < machine.states.size(); ++target) {
      if (target != row.target) add(Kind::retarget, target);
    }
  }
  return list;
}

bool noticed(const std::vector<MachineSubject>& subjects, const TableMutation& mutation) {
  return std::any_of(subjects.begin(), subjects.end(), [&](const MachineSubject& subject) {
    if (subject.machine != mutation.machine) return false;
    return broken_on(subject, {&mutation, 1}, {.sequences = 300, .longest = 60, .shrink = false})
        .has_value();
  });
}

/// Mistakes that change nothing that can be seen, with the reason.
const std::map<std::string, std::string>& explained() {
  static const std::string overruled =
      "where the guard is false the later row of the pair is enabled, and the later one wins";
  static const std::string silent =
      "nothing is scheduled, so no further event comes, whatever the state is called";
  static const std::string counted =
      "the number of the announcement alone decides; Starting does what Periodic does";
  static const std::string never_early =
      "with nothing heard since the last ACKNACK the timer is not due before the reader may ask "
      "again";
  static const std::string not_early =
      "CautiousReader: Answered + TimerFired [Nack<false, false> and TooEarly] -> Answered: ";
  static const std::map<std::string, std::string> list{
      {"Announcer: Starting + AnnouncementDue [InStartup] -> Starting: guard ignored", overruled},
      {"Announcer: Starting + AnnouncementDue [not InStartup] -> Periodic: leads to Starting",
       counted},
      {"Announcer: Periodic + AnnouncementDue -> Periodic: leads to Starting", counted},
      {"CautiousReader: Unheard + HeartbeatReceived [not Fresh] -> Answered: guard ignored",
       overruled},
      {"CautiousReader: Answered + HeartbeatReceived [not Fresh] -> Answered: guard ignored",
       overruled},
      {"CautiousReader: Heard + HeartbeatReceived [not Fresh] -> Heard: guard ignored", overruled},
      {"CautiousReader: Addressed + HeartbeatReceived [not Fresh] -> Addressed: guard ignored",
       overruled},
      {not_early + "missing", never_early},
      {not_early + "action missing", never_early},
      {not_early + "leads to Closed", never_early},
      {not_early + "leads to Unheard", never_early},
      {not_early + "leads to Heard", never_early},
      {not_early + "leads to Addressed", never_early},
      {"ChangeForReader: Absent + Created -> Q: leads to S",
       "what is pushed is serialized in the same instant"},
      {"Channel: Idle + DispatchDue [Waiting] -> Busy: guard ignored",
       "a dispatch is pending only while something waits"},
      {"DiscoveryReader: Recognised + DataReceived [not NothingMissing] -> Recognised: guard "
       "ignored",
       overruled},
      {"DiscoveryReader: EarlyComplete + HeartbeatReceived [AcceptsUnmatched] -> EarlyComplete: "
       "guard ignored",
       "only a reader that accepts unmatched traffic gets there"},
      {"HeartbeatPacer: Pacing + Fired [not Waiting] -> Resting: guard ignored", overruled},
      {"HeartbeatTimer: Idle + ArmRequested [not Adaptive] -> Armed: guard ignored", overruled},
      {"HeartbeatTimer: Armed + Expired [Unacknowledged] -> Armed: guard ignored", overruled},
      {"HeartbeatTimer: Armed + Expired [not Unacknowledged and not LastPending] -> Armed: missing",
       "the row changes nothing and asks for nothing"},
      {"HeartbeatTimer: Pacing + CycleStarted [Unacknowledged] -> Awaiting: guard ignored",
       overruled},
      {"HeartbeatTimer: Awaiting + ResponseReceived [not AllInTime] -> Awaiting: guard ignored",
       overruled},
      {"HeartbeatTimer: Pacing + ResponseReceived [not AllInTime] -> Pacing: guard ignored",
       overruled},
      {"InitialAckNack: Dormant + ReaderOpened [Enabled] -> Waiting: guard ignored", overruled},
      {"InitialAckNack: Dormant + ReaderOpened [not Enabled] -> Done: missing", silent},
      {"InitialAckNack: Dormant + ReaderOpened [not Enabled] -> Done: leads to Dormant", silent},
      {"InitialAckNack: Dormant + ReaderOpened [not Enabled] -> Done: leads to Waiting", silent},
      {"InitialAckNack: Waiting + AttemptDue [not HeartbeatSeen] -> Waiting: guard ignored",
       overruled},
      {"InitialAckNack: Waiting + AttemptDue [HeartbeatSeen] -> Done: missing", silent},
      {"InitialAckNack: Waiting + AttemptDue [HeartbeatSeen] -> Done: leads to Dormant", silent},
      {"InitialAckNack: Waiting + AttemptDue [HeartbeatSeen] -> Done: leads to Waiting", silent}};
  return list;
}

TEST(StatefulMutants, EveryMistakeInARowIsNoticedThatChangesAnything) {
  const std::vector<MachineSubject> subjects = all_subjects();
  std::set<std::string> survivors;
  std::size_t count = 0;
  for (const MachineInfo& machine : machines()) {
    for (const TableMutation& mutation : mistakes(machine)) {
      ++count;
      if (!noticed(subjects, mutation)) survivors.insert(in_words(machine, mutation));
    }
  }
  std::cout << count << " mistakes, " << survivors.size() << " unnoticed\n";
  for (const std::string& survivor : survivors) {
    EXPECT_TRUE(explained().contains(survivor)) << survivor;
  }
  for (const auto& [mistake, reason] : explained()) {
    EXPECT_TRUE(survivors.contains(mistake)) << "noticed after all: " << mistake;
  }
}

TEST(StatefulMutants, WhatIsFoundIsToldAsTheShortestSequence) {
  const TableMutation no_suppression{"DescriptorRepair", 2, Kind::retarget, 0, 0};  // Q -> U
  const auto broken = broken_on(repair_subjects().front(), {&no_suppression, 1}, {});
  ASSERT_TRUE(broken.has_value());
  // A request, its repair, and the repair leaves: three calls suffice.
  EXPECT_NE(broken->find("ACKNACK"), std::string::npos) << *broken;
  EXPECT_NE(broken->find("repair packet leaves its source"), std::string::npos) << *broken;
  EXPECT_EQ(broken->find("suppression end\n"), std::string::npos) << *broken;
}

}  // namespace stateful_test
}  // namespace stormproof::fsm::stateful
