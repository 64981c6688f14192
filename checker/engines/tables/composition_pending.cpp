// composition.pending: what a state waits for is under way. Safety alone does not notice an effect
// that is dropped; this does. Statements about one generic descriptor
// (checker/engines/tables/descriptor_system.hpp), one for each state that something must end.
// Together they are an invariant; if a mutant's rules break one, Spacer says which. They speak of
// what the writer believes; that a receiver that lacks the descriptor is never believed to have it
// makes them statements about the receiver, as live.no-stall is.
#include <algorithm>

#include "checker/engines/tables/houdini.hpp"
#include "checker/engines/tables/properties.hpp"
#include "checker/engines/tables/safety_certificate.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {
namespace {

struct Statement {
  std::string words;
  Expr broken;
};

/// The statements about one composition, and what else is needed to see that steps keep them.
class Statements {
 public:
  Statements(const DescriptorSystem& system, const model::DdsProfile& dds)
      : system_{system}, adaptive_{dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive} {
    model::visit_engine_composition(dds, [this](auto composition) { add(composition); });
    say("while the reader asks by itself, an initial ACKNACK is pending",
        is("InitialTimer=Waiting"), is_pending("InitialAttempt"));
    if (adaptive_) {
      say("between cycles, the start of one is pending", is("HeartbeatClock=Pacing"),
          is_pending("CycleStart") >= 1);
      say("in a cycle, its end is pending", is("HeartbeatClock=Awaiting"),
          is_pending("CycleEnd") >= 1);
    } else {
      say("while the HEARTBEAT timer is armed, an expiry is pending", is("HeartbeatClock=Armed"),
          is_pending("HeartbeatExpiry") >= 1);
    }
  }

  [[nodiscard]] const std::vector<Statement>& list() const { return list_; }
  [[nodiscard]] const Exprs& facts() const { return facts_; }

 private:
  void add(model::Of<fsm::composition::paper::Paper>) {
    say("R: a repair generation is pending", is("C=R"), is_pending("RepairGeneration"));
    say("S: an end of suppression is pending", is("C=S"), is_pending("SuppressionEnd"));
    say("open and not in A: the HEARTBEAT timer runs", is("WriterOpen") && !is("C=A"),
        clock_runs());
  }
  void add(model::Of<fsm::composition::fastdds::FastDds>) {
    say("R: the writer's nack response is asked for", is("C=R"), is("NackResponse=Pending"));
    say("Q: it is in the queue, and the participant's async run is asked for", is("C=Q"),
        is("Enqueued") && is("AsyncRun=Pending"));
    say("S: an end of suppression is asked for", is("C=S"), is("Suppression=Pending"));
    say("U: the HEARTBEAT timer runs", is("C=U"), clock_runs());
    for (const auto& [part, timer] :
         {std::pair{"NackResponse", "NackResponseDue"}, std::pair{"AsyncRun", "AsyncRunDue"},
          std::pair{"Suppression", "SuppressionEnd"}, std::pair{"Reply", "AckNackGeneration"}}) {
      say(std::string{part} + ": what is asked for is pending", is(std::string{part} + "=Pending"),
          is_pending(timer));
    }
    facts_.push_back(is("C=Absent") || (is("WriterOpen") && is("Exists")));
  }

  void say(std::string words, const Expr& waits, const Expr& under_way) {
    list_.push_back({std::move(words), waits && !under_way});
  }
  [[nodiscard]] Expr is(const std::string& variable) const { return system_[variable]; }
  [[nodiscard]] Expr is_pending(const std::string& timer) const {
    return system_["pending " + timer];
  }
  /// It is not idle, and works by the policy that is chosen.
  [[nodiscard]] Expr clock_runs() const {
    if (!adaptive_) return is("HeartbeatClock=Armed");
    return is("HeartbeatClock=Pacing") || is("HeartbeatClock=Awaiting");
  }

  const DescriptorSystem& system_;
  bool adaptive_;
  std::vector<Statement> list_;
  Exprs facts_;
};

/// Which of the statements are kept together by every step; with correct rules all of them. Nothing
/// if a solver has no answer.
std::optional<std::vector<bool>> kept_together(Proof& proof, const DescriptorSystem& descriptor,
                                               const Statements& statements) {
  const Moving moving{descriptor.whole()};
  Exprs candidates = facts_of(moving.system);
  const auto add = [&](const Expr& one) { candidates.push_back(moving(one)); };
  for (const Expr& fact : statements.facts()) add(fact);
  const std::size_t facts = candidates.size();
  for (const Statement& statement : statements.list()) add(!statement.broken);
  auto kept = inductive_together(proof, moving.system, candidates);
  if (kept) kept->erase(kept->begin(), kept->begin() + static_cast<std::ptrdiff_t>(facts));
  return kept;
}

}  // namespace

Finding composition_pending(const CheckRequest& request) {
  Proof proof{"composition.pending", request};
  const DescriptorSystem descriptor = descriptor_system(proof);
  const Statements statements{descriptor, proof.scenario().dds};
  const std::optional<std::vector<bool>> together = kept_together(proof, descriptor, statements);
  if (!together) return proof.finish("an invariant of all statements together was looked for");
  const std::vector<bool>& kept = *together;
  std::string how = std::to_string(std::ranges::count(kept, true)) + " of " +
                    std::to_string(kept.size()) +
                    " statements are together an invariant: they hold initially, and every step "
                    "keeps them";
  for (std::size_t k = 0; k < kept.size() && !proof.violated(); ++k) {
    const Statement& statement = statements.list()[k];
    proof.detail(statement.words);
    if (kept[k]) continue;
    how += "; " + statement.words + ": " +
           prove_unreachable(proof, descriptor.with_bad(statement.broken),
                             "not so: " + statement.words);
  }
  if (!proof.violated()) {
    const std::string words = "the receiver lacks it: the writer does not take it as acknowledged";
    proof.detail(words);
    SafetyStatement statement = acknowledged_is_received(descriptor);
    statement.never.front().breaks = "not so: " + words;
    how += "; " + words + ": " + prove_never(proof, descriptor, statement);
  }
  return proof.finish(how);
}

}  // namespace stormproof::tables
