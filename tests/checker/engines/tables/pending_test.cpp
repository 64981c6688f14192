// Asked implies pending: what a state of a descriptor waits for is under way. Safety alone does not
// notice an effect that is dropped; these do. For any number of descriptors and readers, like all
// that is proved of the derived systems; and each can fail, with an event that is forgotten.
#include "checker/engines/tables/descriptor_system.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace pending_test {

using System = DescriptorSystem;
using BadState = Expr (*)(const System&);

struct Statement {
  const char* words;
  BadState bad;
  model::EventKind forgotten;  ///< what breaks it
};

VerdictKind decide_statement(const model::Scenario& scenario, const Statement& statement,
                             const checker::Mutant* mutant = nullptr) {
  smt::Claims claims{{.second_solver = false}};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = mutant, .on_progress = {}};
  Proof proof{statement.words, request};
  const System system = descriptor_system(proof);
  const std::string how =
      prove_unreachable(proof, system.with_bad(statement.bad(system)), statement.words);
  return proof.finish(how).kind;
}

void check_statement(const model::Scenario& scenario, const Statement& statement) {
  EXPECT_EQ(decide_statement(scenario, statement), VerdictKind::proved) << statement.words;
  checker::Mutant mutant;
  mutant.rules.events.push_back(
      {statement.forgotten, model::EventMutation::Change::forget, {}, {}});
  EXPECT_EQ(decide_statement(scenario, statement, &mutant), VerdictKind::violated)
      << statement.words;
}

Expr none_pending(const System& s, const char* timer) {
  return !s[std::string{"pending "} + timer];
}

TEST(Pending, InThePapersModel) {
  for (const Statement& statement : {
           Statement{
               "R: a repair generation is pending",
               [](const System& s) { return s["C=R"] && none_pending(s, "RepairGeneration"); },
               model::EventKind::repair_generation},
           Statement{"S: an end of suppression is pending",
                     [](const System& s) { return s["C=S"] && none_pending(s, "SuppressionEnd"); },
                     model::EventKind::suppression_end},
           Statement{"open and not in A: an expiry is pending",
                     [](const System& s) {
                       return s["WriterOpen"] && !s["C=A"] && s["pending HeartbeatExpiry"] < 1;
                     },
                     model::EventKind::heartbeat_expiry},
       }) {
    check_statement(paper(), statement);
  }
}

TEST(Pending, InFastDds) {
  for (const Statement& statement : {
           Statement{"R: the writer's nack response is pending",
                     [](const System& s) {
                       return s["C=R"] &&
                              (!s["NackResponse=Pending"] || none_pending(s, "NackResponseDue"));
                     },
                     model::EventKind::nack_response},
           Statement{"Q: it is in the queue, and the participant's async run is pending",
                     [](const System& s) {
                       return s["C=Q"] && (!s["Enqueued"] || !s["AsyncRun=Pending"] ||
                                           none_pending(s, "AsyncRunDue"));
                     },
                     model::EventKind::async_run},
           Statement{"S: an end of suppression is pending",
                     [](const System& s) {
                       return s["C=S"] &&
                              (!s["Suppression=Pending"] || none_pending(s, "SuppressionEnd"));
                     },
                     model::EventKind::suppression_end},
           Statement{"U: an expiry is pending",
                     [](const System& s) { return s["C=U"] && s["pending HeartbeatExpiry"] < 1; },
                     model::EventKind::heartbeat_expiry},
           Statement{"a reply that was asked for is pending",
                     [](const System& s) {
                       return s["Reply=Pending"] && none_pending(s, "AckNackGeneration");
                     },
                     model::EventKind::acknack_generation},
       }) {
    check_statement(fastdds(), statement);
  }
}

/// A proof about a system in which nothing happens would prove nothing.
TEST(Pending, IsSaidOfStatesThatAreReached) {
  for (const auto& [scenario, state] :
       {std::pair{paper(), "C=S"}, std::pair{paper(), "C=A"}, std::pair{fastdds(), "C=Q"}}) {
    smt::Claims claims{{.second_solver = false}};
    const checker::CheckRequest request{.scenario = scenario, .claims = claims, .on_progress = {}};
    Proof proof{state, request};
    const System system = descriptor_system(proof);
    const std::string how = prove_unreachable(proof, system.with_bad(system[state]), state);
    EXPECT_EQ(proof.finish(how).kind, VerdictKind::violated) << state;
  }
}

}  // namespace pending_test
}  // namespace stormproof::tables
