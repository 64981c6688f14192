// Deliberate mistakes in a run: each kind of event mistake does what its name says, a mistake in a
// table replaces Boost.MSM by the mutated table, a live bitmap is not the one that was emitted, and
// no mistake can break the simulator itself.
#include "model/mutation.hpp"

#include <map>

#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace mutation_test {

using Change = EventMutation::Change;
using fsm::TableMutation;

Mutation event_mistake(EventKind kind, Change change, Nanoseconds by = {},
                       EventClass event_class = {}) {
  Mutation mutation;
  mutation.events.push_back({kind, change, by, event_class});
  return mutation;
}

/// Two participants with two publications each, 1 ms apart.
Scenario pair_of_participants() { return by_hand({{0, 2}, {1, 2}}); }

std::vector<std::int64_t> due_times(const RunLog& log, EventKind kind) {
  std::vector<std::int64_t> times;
  for (const Scheduled& event : log.scheduled) {
    if (event.kind == kind) times.push_back(event.due_ns);
  }
  return times;
}

TEST(EventMutation, AForgottenEventIsNotScheduled) {
  const Mutation mistake = event_mistake(EventKind::acknack_generation, Change::forget);
  Scenario scenario = pair_of_participants();
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{sec};
  EXPECT_GT(due_times(run_and_log(scenario), EventKind::acknack_generation).size(), 0U);
  const RunLog log = run_and_log(scenario, &mistake);
  EXPECT_EQ(due_times(log, EventKind::acknack_generation).size(), 0U);
  EXPECT_EQ(log.result.counts.acknack, 0U);
  EXPECT_TRUE(log.result.completed());  // DATA is pushed
}

TEST(EventMutation, AShiftedEventComesLaterByThat) {
  const Scenario scenario = pair_of_participants();
  const Mutation late = event_mistake(EventKind::acknack_generation, Change::shift, Nanoseconds{7});
  const auto right = due_times(run_and_log(scenario), EventKind::acknack_generation);
  auto expected = right;
  for (std::int64_t& time : expected) time += 7;
  ASSERT_FALSE(right.empty());
  EXPECT_EQ(due_times(run_and_log(scenario, &late), EventKind::acknack_generation), expected);
}

TEST(EventMutation, NoShiftLeadsIntoThePast) {
  const Scenario scenario = pair_of_participants();
  const Mutation early =
      event_mistake(EventKind::acknack_generation, Change::shift, Nanoseconds{-sec});
  const RunLog log = run_and_log(scenario, &early);
  std::size_t seen = 0;
  for (const Scheduled& event : log.scheduled) {
    if (event.kind != EventKind::acknack_generation) continue;
    EXPECT_EQ(event.due_ns, event.at_ns);
    ++seen;
  }
  EXPECT_GT(seen, 0U);
}

TEST(EventMutation, ADuplicateComesTwice) {
  const Scenario scenario = pair_of_participants();
  const Mutation twice = event_mistake(EventKind::acknack_generation, Change::duplicate);
  const auto right = due_times(run_and_log(scenario), EventKind::acknack_generation);
  std::vector<std::int64_t> expected;
  for (const std::int64_t time : right) expected.insert(expected.end(), 2, time);
  ASSERT_FALSE(right.empty());
  EXPECT_EQ(due_times(run_and_log(scenario, &twice), EventKind::acknack_generation), expected);
}

/// The class with which events of one kind were processed.
class ClassProbe final : public Probe {
 public:
  explicit ClassProbe(EventKind kind) : kind_{kind} {}
  void event_started(const Event& event) override {
    if (event.kind == kind_) ++classes[event.event_class()];
  }
  std::map<EventClass, int> classes;

 private:
  EventKind kind_;
};

TEST(EventMutation, AReclassedEventHasAnotherClass) {
  const Scenario scenario = pair_of_participants();
  const Mutation wrong =
      event_mistake(EventKind::delayed_reception, Change::reclass, {}, EventClass::dispatch);
  for (const Mutation* mutation : {static_cast<const Mutation*>(nullptr), &wrong}) {
    ClassProbe probe{EventKind::delayed_reception};
    RunOptions options;
    options.probe = &probe;
    options.mutation = mutation;
    const RunResult result = simulate(scenario, options);
    EXPECT_TRUE(result.completed());
    ASSERT_EQ(probe.classes.size(), 1U);
    EXPECT_EQ(probe.classes.begin()->first,
              mutation == nullptr ? EventClass::service : EventClass::dispatch);
  }
}

/// Row of a machine, by its names.
TableMutation mistake_in_row(const std::string& machine, std::string_view source,
                             std::string_view event, std::string_view target,
                             TableMutation::Kind kind) {
  for (const fsm::MachineInfo& info : fsm::machines()) {
    if (info.name != machine) continue;
    for (std::size_t row = 0; row < info.rows.size(); ++row) {
      const fsm::RowInfo& r = info.rows[row];
      if (info.states[r.source] == source && info.events[r.event] == event &&
          info.states[r.target] == target) {
        return {machine, row, kind, 0, 0};
      }
    }
  }
  ADD_FAILURE() << "no such row";
  return {};
}

TEST(TableMutationOfARun, ADroppedRowNeverFires) {
  Scenario scenario = pair_of_participants();
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{2 * sec};
  Mutation mutation;
  mutation.tables.push_back(mistake_in_row("DescriptorRepair", "U", "AckNackReceived", "A",
                                           TableMutation::Kind::drop_row));
  const auto acknowledgments = [](const RunLog& log) {
    return std::ranges::count_if(log.transitions, [](const std::string& text) {
      return text.find("AckNackReceived -> A") != std::string::npos;
    });
  };
  EXPECT_GT(acknowledgments(run_and_log(scenario)), 0);
  EXPECT_EQ(acknowledgments(run_and_log(scenario, &mutation)), 0);
}

TEST(TableMutationOfARun, AMistakeInTheReaderIsSeenInTheRun) {
  Scenario scenario = pair_of_participants();
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{2 * sec};
  Mutation mutation;
  mutation.tables.push_back(mistake_in_row("DiscoveryReader", "Complete", "HeartbeatReceived",
                                           "Complete", TableMutation::Kind::drop_action));
  const auto answers = [](const RunLog& log) {
    return due_times(log, EventKind::acknack_generation).size();
  };
  EXPECT_GT(answers(run_and_log(scenario)), 0U);
  EXPECT_EQ(answers(run_and_log(scenario, &mutation)), 0U);
}

TEST(TableMutationOfARun, AMistakeElsewhereChangesNothing) {
  for (const Scenario& scenario : {pair_of_participants(), [] {
                                     Scenario busy;
                                     busy.deployment = Deployment::homogeneous(2, 2, 10);
                                     return busy;
                                   }()}) {
    // A row of a machine that only the other implementation has.
    Mutation mutation;
    mutation.tables.push_back(
        mistake_in_row("ChangeForReader", "Q", "Serialized", "S", TableMutation::Kind::drop_row));
    const RunLog right = run_and_log(scenario);
    const RunLog same = run_and_log(scenario, &mutation);
    EXPECT_EQ(right.transitions, same.transitions);
    EXPECT_EQ(right.result.end_time, same.result.end_time);
    EXPECT_EQ(right.result.counts, same.result.counts);
  }
}

/// Bitmaps of the ACKNACKs as they were emitted, and as they were received.
class BitmapProbe final : public Probe {
 public:
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    if (packet.kind == PacketKind::acknack) {
      emitted_[packet.number] = {packet.descriptors.count(), packet.detail};
    }
  }
  void received(const Packet& packet, std::uint32_t) override {
    if (packet.kind != PacketKind::acknack || !emitted_.contains(packet.number)) return;
    ++seen;
    const auto [members, base] = emitted_[packet.number];
    changed += packet.descriptors.count() != members || packet.detail != base ? 1 : 0;
  }
  int seen = 0;
  int changed = 0;

 private:
  std::map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> emitted_;
};

void expect_live_bitmaps(const Scenario& scenario) {
  Mutation live;
  live.live_bitmaps = true;
  for (const Mutation* mutation : {static_cast<const Mutation*>(nullptr), &std::as_const(live)}) {
    BitmapProbe probe;
    RunOptions options;
    options.probe = &probe;
    options.mutation = mutation;
    EXPECT_TRUE(simulate(scenario, options).completed());
    EXPECT_GT(probe.seen, 0);
    EXPECT_EQ(probe.changed > 0, mutation != nullptr);
  }
}

TEST(LiveBitmaps, DifferFromWhatWasEmitted) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 10);
  expect_live_bitmaps(scenario);
}

TEST(LiveBitmaps, DifferFromWhatWasEmittedWithFastddsToo) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 10);
  scenario.dds.implementation = ImplementationKind::fastdds;
  expect_live_bitmaps(scenario);
}

/// Every kind of mistake on every event and on every row, in both implementations and both kinds of
/// service: the run ends, and what it reports is consistent.
class AnyMistake : public testing::TestWithParam<int> {};

Scenario small(int variant) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 2, 4);
  if (variant % 2 == 1) scenario.dds.implementation = ImplementationKind::fastdds;
  if (variant / 2 % 2 == 1) scenario.dds.sedp.heartbeat_policy = HeartbeatPolicy::adaptive;
  if (variant / 4 == 1) {
    scenario.wireless.kind = ServiceKind::constant_delay;
    scenario.wireless.one_way = Nanoseconds{ms};
  }
  scenario.wireless.lost_packets = {3, 5, 9, 12, 13, 20, 27};
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{5 * sec};
  return scenario;
}

void expect_sane(const Scenario& scenario, const Mutation& mutation) {
  constexpr std::uint64_t most = 2'000;
  RunOptions options;
  options.mutation = &mutation;
  options.max_events = most;
  const RunResult result = simulate(scenario, options);
  EXPECT_LE(result.events, most);
  EXPECT_NE(result.end, RunEnd::completed);
  EXPECT_EQ(result.completed(), result.missing_count == 0);
  EXPECT_GE(result.end_time, result.discovery_time.value_or(Nanoseconds{0}));
}

TEST_P(AnyMistake, InTheEventsLeavesTheSimulatorIntact) {
  const Scenario scenario = small(GetParam());
  for (std::size_t k = 0; k < event_kind_count; ++k) {
    const auto kind = static_cast<EventKind>(k);
    expect_sane(scenario, event_mistake(kind, Change::forget));
    expect_sane(scenario, event_mistake(kind, Change::duplicate));
    expect_sane(scenario, event_mistake(kind, Change::shift, Nanoseconds{1}));
    expect_sane(scenario, event_mistake(kind, Change::shift, Nanoseconds{-sec}));
    for (const EventClass c : {EventClass::service, EventClass::protocol, EventClass::dispatch}) {
      expect_sane(scenario, event_mistake(kind, Change::reclass, {}, c));
    }
  }
}

TEST_P(AnyMistake, InATableLeavesTheSimulatorIntact) {
  using Kind = TableMutation::Kind;
  const Scenario scenario = small(GetParam());
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    for (std::size_t row = 0; row < machine.rows.size(); ++row) {
      for (const Kind kind :
           {Kind::drop_row, Kind::negate_guard, Kind::ignore_guard, Kind::drop_action}) {
        Mutation mutation;
        mutation.tables.push_back({std::string{machine.name}, row, kind, 0, 0});
        expect_sane(scenario, mutation);
      }
      for (std::uint8_t state = 0; state < machine.states.size(); ++state) {
        Mutation elsewhere;
        elsewhere.tables.push_back({std::string{machine.name}, row, Kind::retarget, 0, state});
        expect_sane(scenario, elsewhere);
        Mutation copied;
        copied.tables.push_back({std::string{machine.name}, row, Kind::copy_row, state, state});
        expect_sane(scenario, copied);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, AnyMistake, testing::Range(0, 8));

}  // namespace mutation_test
}  // namespace stormproof::model
