// composition.pending: what a state waits for is under way; each of its statements can fail, with
// an event that is forgotten or a row that asks for nothing.
#include "checker/engines/tables/descriptor_system.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace pending_test {

using model::EventKind;

model::Scenario adaptive(model::Scenario scenario) {
  scenario.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  return scenario;
}

TEST(Pending, IsProvedByAnInvariant) {
  model::Scenario pull = paper();
  pull.dds.sedp.initial_data = model::InitialData::pull;
  pull.dds.sedp.relation_opening = model::RelationOpening::each_side;
  pull.dds.sedp.acknowledge = model::Acknowledge::prefix;
  for (const model::Scenario& scenario :
       {paper(), pull, adaptive(paper()), fastdds(), adaptive(fastdds())}) {
    const Finding finding = decide("composition.pending", scenario);
    EXPECT_EQ(finding.kind, VerdictKind::proved) << finding.how;
    EXPECT_NE(finding.how.find("together an invariant"), std::string::npos) << finding.how;
  }
}

struct Forgotten {
  EventKind event;
  const char* words;  ///< of the statement that it breaks
};

void check_forgotten(const model::Scenario& scenario, const Forgotten& forgotten) {
  checker::Mutant mutant;
  mutant.rules.events.push_back({forgotten.event, model::EventMutation::Change::forget, {}, {}});
  expect_violated("composition.pending", scenario, mutant,
                  std::string{"not so: "} + forgotten.words);
}

TEST(Pending, EachStatementOfThePaperNoticesWhatItWaitsFor) {
  for (const Forgotten& forgotten :
       {Forgotten{EventKind::repair_generation, "R: a repair generation is pending"},
        Forgotten{EventKind::suppression_end, "S: an end of suppression is pending"},
        Forgotten{EventKind::heartbeat_expiry, "while the HEARTBEAT timer is armed, an expiry"},
        Forgotten{EventKind::initial_acknack_due, "while the reader asks by itself"}}) {
    check_forgotten(paper(), forgotten);
  }
  check_forgotten(adaptive(paper()), {EventKind::cycle_start, "between cycles"});
  check_forgotten(adaptive(paper()), {EventKind::cycle_end, "in a cycle, its end"});
}

TEST(Pending, EachStatementOfFastDdsNoticesWhatItWaitsFor) {
  for (const Forgotten& forgotten :
       {Forgotten{EventKind::suppression_end, "Suppression: what is asked for is pending"},
        Forgotten{EventKind::heartbeat_expiry, "while the HEARTBEAT timer is armed, an expiry"},
        Forgotten{EventKind::acknack_generation, "Reply: what is asked for is pending"}}) {
    check_forgotten(fastdds(), forgotten);
  }
}

TEST(Pending, NoticesATimerThatIsNotAskedFor) {
  const std::size_t request = row_of("ChangeForReader", "U", "AckNackReceived", "R");
  expect_violated("composition.pending", fastdds(),
                  with_row("ChangeForReader", request, fsm::TableMutation::Kind::drop_action),
                  "not so: R: the writer's nack response is asked for");
  const std::size_t arm = row_of("HeartbeatTimer", "Idle", "ArmRequested", "Armed");
  expect_violated("composition.pending", paper(),
                  with_row("HeartbeatTimer", arm, fsm::TableMutation::Kind::drop_row),
                  "not so: open and not in A: the HEARTBEAT timer runs");
}

TEST(Pending, IsSaidOfTheReceiverWhateverTheWriterBelieves) {
  // A writer that takes what it sends as acknowledged has nothing pending, and believes that it
  // needs nothing.
  const std::size_t row = row_of("DescriptorRepair", "U", "AckNackReceived", "A");
  expect_violated("composition.pending", paper(),
                  with_row("DescriptorRepair", row, fsm::TableMutation::Kind::ignore_guard),
                  "not so: the receiver lacks it");
}

/// A proof about a system in which nothing happens would prove nothing.
TEST(Pending, IsSaidOfStatesThatAreReached) {
  for (const auto& [scenario, state] :
       {std::pair{paper(), "C=S"}, std::pair{paper(), "C=A"}, std::pair{fastdds(), "C=Q"}}) {
    smt::Claims claims{{.second_solver = false}};
    const checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
    Proof proof{state, request};
    const DescriptorSystem system = descriptor_system(proof);
    const std::string how = prove_unreachable(proof, system.with_bad(system[state]), state);
    EXPECT_EQ(proof.finish(how).kind, VerdictKind::violated) << state;
  }
}

}  // namespace pending_test
}  // namespace stormproof::tables
