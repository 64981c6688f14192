// Every monitor can object: runs with a deliberate mistake in the rules, or held against another
// specification than the one that ran. Each case names a property that must notice; where the
// correct run is silent about that property, the test checks so.
#include <gtest/gtest.h>

#include "fsm/machines.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace mistakes_test {

using fsm::TableMutation;
using model::EventClass;
using model::EventKind;
using model::EventMutation;
using model::Mutation;
using model::Scenario;

/// The row of the table, by its source, event and target; and what is done to it.
TableMutation row(const std::string& machine, const std::string& text, TableMutation::Kind kind,
                  const std::string& state = {}) {
  TableMutation mutation;
  mutation.machine = machine;
  mutation.kind = kind;
  bool found = false;
  for (const fsm::MachineInfo& info : fsm::machines()) {
    if (info.name != machine) continue;
    for (std::size_t k = 0; k < info.rows.size(); ++k) {
      const auto& r = info.rows[k];
      const std::string name = std::string{info.states[r.source]} + " " +
                               std::string{info.events[r.event]} + " " +
                               std::string{info.states[r.target]};
      if (name != text) continue;
      mutation.row = k;
      mutation.target = r.target;
      found = true;
    }
    for (std::size_t s = 0; s < info.states.size(); ++s) {
      if (info.states[s] != state) continue;
      (kind == TableMutation::Kind::copy_row ? mutation.source : mutation.target) =
          static_cast<std::uint8_t>(s);
    }
  }
  EXPECT_TRUE(found) << machine << ": " << text;
  return mutation;
}

EventMutation event(EventKind kind, EventMutation::Change change,
                    EventClass event_class = EventClass::dispatch) {
  return {kind, change, model::Nanoseconds{1}, event_class};
}

/// A shipped scenario with overrides, which is not read before it is asked for: every process that
/// runs a test lists the cases.
struct Setting {
  const char* shipped_name;
  std::vector<std::string> overrides;
  [[nodiscard]] Scenario scenario() const { return shipped(shipped_name, overrides); }
};

Setting small_deployment(const char* name, const std::vector<std::string>& more) {
  std::vector<std::string> overrides{"deployment.participants_per_host=2",
                                     "deployment.endpoints_per_participant=4",
                                     "run_until=time_limit", "time_limit=8s"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return {name, overrides};
}
Setting small(const std::vector<std::string>& more = {}) {
  return small_deployment("smallest", more);
}
Setting small_fastdds(const std::vector<std::string>& more = {}) {
  return small_deployment("wifi-5x20-fastdds", more);
}
Setting small_cyclone(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"dds=cyclonedds-0.10"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return small(overrides);
}

const std::vector<std::string> one_ms{"wireless={kind: constant_delay, one_way: 1ms}"};
const std::vector<std::string> lossy{"wireless.lost_packets=[2,5,9,12,14,17,21,30]"};

struct Case {
  const char* name;
  const char* property;
  Setting setting;
  Mutation mistake;
};

Mutation tables(std::vector<TableMutation> rows, std::vector<EventMutation> events = {}) {
  return {std::move(rows), std::move(events), {}, false};
}
Mutation events(std::vector<EventMutation> list) { return {{}, std::move(list), {}, false}; }

using Kind = TableMutation::Kind;
using Change = EventMutation::Change;

std::vector<Case> paper_cases() {
  const char* const repair = "DescriptorRepair";
  return {
      {"ReceptionAfterDecision", "order.reception-first", small(one_ms),
       events({event(EventKind::delayed_reception, Change::reclass)})},
      {"ChannelStartsTooEarly", "order.reception-first", small(),
       events({event(EventKind::dispatch, Change::reclass, EventClass::service)})},
      {"AcknowledgesTooMuch", "safety.ack-implies-received", small(lossy),
       tables({row(repair, "U AckNackReceived A", Kind::ignore_guard)})},
      {"RepairCountsAsAcknowledged", "safety.ack-implies-received", small(lossy),
       tables({row(repair, "S SuppressionEnded U", Kind::retarget, "A")})},
      {"RepairsTwice", "safety.repair-only-if-asked", small(),
       tables({row(repair, "R RepairDue Q", Kind::retarget, "R")},
              {event(EventKind::repair_generation, Change::duplicate)})},
      {"LiveBitmap", "safety.snapshot", small(), Mutation{{}, {}, {}, true}},
      {"TakesDataWithoutNoting", "safety.snapshot", small(),
       tables({row("DiscoveryReader", "Recognised DataReceived Complete", Kind::drop_action)})},
      {"LateDispatch", "safety.conservation", small(),
       events({event(EventKind::dispatch, Change::shift)})},
      {"ForgottenDispatch", "safety.conservation", small(),
       events({event(EventKind::dispatch, Change::forget)})},
      {"ForgottenEndOfService", "safety.conservation", small(),
       events({event(EventKind::service_finished, Change::forget)})},
      {"TwoServicesAtOnce", "safety.conservation", small(),
       tables({row("Channel", "Idle DispatchDue Busy", Kind::retarget, "Idle")})},
      {"TwoExpiries", "timer.single-heartbeat", small(),
       events({event(EventKind::heartbeat_expiry, Change::duplicate)})},
      {"ArmsAgain", "timer.single-heartbeat", small(),
       tables({row("HeartbeatTimer", "Idle ArmRequested Armed", Kind::copy_row, "Armed")})},
      {"TwoCycles", "timer.single-heartbeat", small({"dds.sedp.heartbeat_policy=adaptive"}),
       events({event(EventKind::cycle_start, Change::duplicate)})},
      {"NoSuppression", "timer.suppression-honoured", small(),
       tables({row(repair, "R RepairDue Q", Kind::retarget, "S")},
              {event(EventKind::repair_generation, Change::duplicate)})},
      {"ForgottenRepair", "live.no-stall", small(lossy),
       events({event(EventKind::repair_generation, Change::forget)})},
      {"RepairRowMissing", "live.no-stall", small(lossy),
       tables({row(repair, "R RepairDue Q", Kind::drop_row)})},
      {"ForgottenAckNack", "live.completion",
       small({"wireless.lost_packets=[5,9,12]", "time_limit=60s"}),
       events({event(EventKind::acknack_generation, Change::forget)})},
      {"ForgottenHeartbeats", "live.no-stall",
       small({"wireless.lost_packets=[4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25]",
              "dds.sedp.initial_acknack_delay=0s"}),
       events({event(EventKind::heartbeat_expiry, Change::forget)})},
      {"ForgottenAnnouncements", "live.no-stall", small(),
       events({event(EventKind::announcement_due, Change::forget)})},
      {"WronglyAcknowledged", "live.no-stall", small(lossy),
       tables({row(repair, "U AckNackReceived A", Kind::ignore_guard)})},
      {"CompleteTooEarly", "live.completion", small({"dds.sedp.piggyback=off"}),
       tables({row("DiscoveryReader", "Unknown AnnouncementReceived Recognised", Kind::retarget,
                   "Complete")})},
      {"NeverAcknowledges", "live.quiescence", small(),
       tables({row(repair, "U AckNackReceived A", Kind::drop_row)})},
      {"AnsweredTwice", "composition.followed", small(),
       events({event(EventKind::acknack_generation, Change::duplicate)})},
  };
}

std::vector<Case> fastdds_cases() {
  const char* const change = "ChangeForReader";
  return {
      {"FastddsDecisionAfterDispatch", "order.reception-first", small_fastdds(),
       events({event(EventKind::nack_response, Change::reclass)})},
      {"FastddsRepairCountsAsAcknowledged", "safety.ack-implies-received", small_fastdds(lossy),
       tables({row(change, "S SuppressionEnded U", Kind::retarget, "A")})},
      {"FastddsSerializedForever", "safety.repair-only-if-asked", small_fastdds(),
       tables({row(change, "Q Serialized S", Kind::retarget, "R")})},
      {"FastddsLiveBitmap", "safety.snapshot", small_fastdds(), Mutation{{}, {}, {}, true}},
      {"FastddsForgottenReception", "safety.conservation", small_fastdds(),
       events({event(EventKind::reception, Change::forget)})},
      {"FastddsTwoExpiries", "timer.single-heartbeat", small_fastdds(),
       events({event(EventKind::heartbeat_expiry, Change::duplicate)})},
      {"FastddsForgottenResponse", "live.no-stall", small_fastdds(),
       events({event(EventKind::nack_response, Change::forget)})},
      {"FastddsForgottenAsyncRun", "live.no-stall", small_fastdds(),
       events({event(EventKind::async_run, Change::forget)})},
      {"FastddsForgottenCreations", "live.no-stall", small_fastdds(),
       events({event(EventKind::endpoint_creation, Change::forget)})},
      {"FastddsForgottenSuppressionEnd", "live.no-stall", small_fastdds(lossy),
       events({event(EventKind::suppression_end, Change::forget)})},
      {"FastddsCompleteTooEarly", "live.completion", small_fastdds({"dds.sedp.piggyback=off"}),
       tables({row("DiscoveryReader", "Unknown AnnouncementReceived Recognised", Kind::retarget,
                   "Complete")})},
      {"FastddsNeverAcknowledges", "live.quiescence", small_fastdds(),
       tables({row(change, "U AckNackReceived A", Kind::drop_row)})},
      {"FastddsLateResponse", "composition.followed", small_fastdds(),
       events({event(EventKind::nack_response, Change::shift)})},
  };
}

std::vector<Case> cyclone_cases() {
  return {
      {"CycloneDecisionAfterDispatch", "order.reception-first", small_cyclone(),
       events({event(EventKind::thread_run, Change::reclass)})},
      {"CycloneForgottenReception", "safety.conservation", small_cyclone(),
       events({event(EventKind::reception, Change::forget)})},
      {"CycloneAnyAckNackReplies", "safety.ack-implies-received", small_cyclone(lossy),
       tables({row("MatchedReader", "Silent AckNackReceived Silent", Kind::retarget, "Replied")})},
      {"CycloneForgottenHeartbeats", "live.no-stall", small_cyclone(),
       events({event(EventKind::heartbeat_time, Change::forget)})},
      {"CycloneLateRun", "composition.followed", small_cyclone(),
       events({event(EventKind::thread_run, Change::shift)})},
  };
}

/// Half of the endpoints exist when clients are matched with the server, after 450 ms.
std::vector<std::string> created_late(std::vector<std::string> more) {
  more.emplace_back("deployment.schedule.start=[0s, 1ms]");
  more.emplace_back("deployment.schedule.endpoints_done=[900ms, 910ms]");
  return more;
}
/// Packets 20, 25, … 400.
std::string every_fifth() {
  std::string list = "[20";
  for (int number = 25; number <= 400; number += 5) list += "," + std::to_string(number);
  return list + "]";
}

/// What clients tell a server, and it them.
std::vector<Case> server_cases() {
  const char* const change = "ChangeForReader";
  const auto with_server = [](std::vector<std::string> more = {}) {
    more.emplace_back("dds=fastdds-server-2.6.11");
    return small_fastdds(more);
  };
  return {
      {"ServerRepairCountsAsAcknowledged", "safety.ack-implies-received", with_server(lossy),
       tables({row(change, "S SuppressionEnded U", Kind::retarget, "A")})},
      {"ServerSerializedForever", "safety.repair-only-if-asked",
       with_server(created_late({"wireless.lost_packets=" + every_fifth()})),
       tables({row(change, "Q Serialized S", Kind::retarget, "R")})},
      {"ServerLiveBitmap", "safety.snapshot",
       with_server(created_late({"wireless={kind: constant_delay, one_way: 60ms}",
                                 "dds.sedp.piggyback_threshold_bytes=500"})),
       Mutation{{}, {}, {}, true}},
      {"ServerForgottenReception", "safety.conservation", with_server(),
       events({event(EventKind::reception, Change::forget)})},
      {"ServerTwoExpiries", "timer.single-heartbeat", with_server(),
       events({event(EventKind::heartbeat_expiry, Change::duplicate)})},
      {"ServerLateRoutine", "composition.followed", with_server(),
       events({event(EventKind::server_routine_again, Change::shift)})},
      {"ServerForgetsToSend", "composition.followed", with_server(),
       events({event(EventKind::server_sending, Change::forget)})},
      {"ServerRelaysAnswerTwice", "composition.followed", with_server(),
       events({event(EventKind::relay_response, Change::duplicate)})},
      {"ServerRequestsAreIgnored", "composition.followed", with_server(lossy),
       tables({row(change, "U AckNackReceived R", Kind::drop_row)})},
  };
}

const std::vector<Case>& all_cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> cases = paper_cases();
    for (Case& one : fastdds_cases()) cases.push_back(std::move(one));
    for (Case& one : cyclone_cases()) cases.push_back(std::move(one));
    for (Case& one : server_cases()) cases.push_back(std::move(one));
    return cases;
  }();
  return all;
}

class Mistakes : public testing::TestWithParam<std::size_t> {};

TEST_P(Mistakes, AreNoticed) {
  const Case& tested = all_cases()[GetParam()];
  const Scenario scenario = tested.setting.scenario();
  const MonitoredRun correct = run_monitored(scenario);
  EXPECT_EQ(correct.violation(tested.property), nullptr)
      << tested.name << ": " << correct.violation(tested.property)->reason;
  model::RunOptions options;
  options.mutation = &tested.mistake;
  options.max_events = 150'000;
  const MonitoredRun run = run_monitored(scenario, scenario, options);
  ASSERT_NE(run.violation(tested.property), nullptr)
      << tested.name << " noticed only: " << run.violated();
  EXPECT_LT(run.violation(tested.property)->event, std::max<std::uint64_t>(run.result.events, 1));
  EXPECT_EQ(run.violation(tested.property)->reason.back(), '.');
}

INSTANTIATE_TEST_SUITE_P(All, Mistakes, testing::Range(std::size_t{0}, all_cases().size()),
                         [](const auto& tested) { return all_cases()[tested.param].name; });

TEST(OtherSpecification, SmallerQueueThanTheOneThatRuns) {
  const Scenario runs = shipped("wifi-5x20");
  Scenario specification = runs;
  specification.wireless.source_queue_bytes = model::Bytes{100'000};
  EXPECT_NE(run_monitored(runs, specification).violation("safety.conservation"), nullptr);
}

TEST(OtherSpecification, LongerSuppressionThanTheOneThatRuns) {
  const Scenario runs = shipped("wifi-5x20");
  Scenario specification = runs;
  specification.dds.sedp.nack_suppression_duration = model::Nanoseconds{20'000};
  EXPECT_NE(run_monitored(runs, specification).violation("timer.suppression-honoured"), nullptr);
}

}  // namespace mistakes_test
}  // namespace stormproof::props
