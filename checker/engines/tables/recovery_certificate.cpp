// The invariant over the steps of the amended rules. While a descriptor is missing, an attempt of
// the initial ACKNACK is pending, and the descriptor's state at the writer says what is under way:
// the attempt itself, which comes by the ghost `limit`, or a stage of the exchange that an attempt
// starts, as much later as it may take. A loss moves the limit to the attempt after everything that
// the lost packet has suppressed: where distances double, as far again as it is from the opening.
// That this is enough is what the conditions decide.
// Rules: §InitialAckNackDue, §AckNackArrives, §AnswerInitial (specs/guide/museum.md).
#include "checker/engines/tables/recovery_certificate.hpp"

#include <string>
#include <vector>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/properties.hpp"
#include "checker/engines/tables/timed_certificate.hpp"

namespace stormproof::tables {
namespace {

/// The distances of attempts.
bool doubles(const model::DdsProfile& dds) {
  return dds.sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling;
}

class Recovery : public TimedStatement {
 public:
  Recovery(const TimedDescriptor& system, const model::DdsProfile& dds)
      : TimedStatement{system},
        response_{system.delays().response.expr()},
        nack_{system.delays().nack.expr()},
        suppression_{system.delays().suppression.expr()},
        delta_{system.delays().delta.expr()},
        limit_{is(timed::limit)},
        reader_open_{is("Reader=Recognised") || is("Reader=Complete")},
        waiting_{is("InitialTimer=Waiting")},
        missing_{is(watched::counting) && !is("X")} {
    for (const char* kind : {"Heartbeat", "AckNack", watched::initial_acknack, "Data"}) {
      arrives_in_time(kind);
    }
    within("AckNackGeneration", pending("AckNackGeneration"), response_);
    within("RepairGeneration", pending("RepairGeneration"), nack_);
    within("SuppressionEnd", pending("SuppressionEnd"), suppression_);
    repairs_leave_in_time();
    say("the last request is past", is("LastNack") <= now());
    const Expr asked_for = can_be_asked_for(dds, [&](const char* name) { return is(name); });
    say("what can be asked for counts, and nothing else",
        is(watched::counting) == (asked_for && reader_open_));
    attempts(doubles(dds));
    stages();
    conclusions.push_back({"what is missing is received by the limit + F",
                           if_then(missing_, by(now(), received_by()))});
  }

 private:
  /// Those of a reader that lacks something go on.
  void attempts(bool double_their_distance) {
    const Expr opened = is(watched::opened);
    const Expr first = system_.initial();
    const Expr distance = is("LastDelay");
    say("a side that was opened waits for an attempt, or is done with them",
        reader_open_ != is("InitialTimer=Dormant"));
    say("an attempt is pending, and only one, exactly while it is waited for",
        pending("InitialAttempt") == z3::ite(waiting_, number(1), number(0)));
    say("whoever lacks it goes on asking", if_then(reader_open_ && !is("X"), waiting_));
    say("the opening is past", if_then(reader_open_, opened <= now()));
    say("what is pending is not overdue", if_then(waiting_, now() <= due("InitialAttempt")));
    if (double_their_distance) {
      say("a distance is as long as all before it and τ_I",
          if_then(waiting_, distance + distance == due("InitialAttempt") - opened + first &&
                                distance <= now() - opened + first));
    } else {
      say("each distance is τ_I",
          if_then(waiting_, distance == first && due("InitialAttempt") <= now() + first));
    }
  }

  /// While the descriptor is missing one of these is under way.
  void stages() {
    const Expr initial_by = limit_ + delta_;
    const Expr heartbeat_by = initial_by + delta_;
    const Expr asks =
        by(due("InitialAttempt"), limit_) || arrives_by(watched::initial_acknack, initial_by);
    const Expr answered =
        arrives_by("Heartbeat", heartbeat_by) ||
        (pending("AckNackGeneration") && by(due("AckNackGeneration"), heartbeat_by + response_)) ||
        arrives_by("AckNack", requested_by());
    const Expr requested =
        is("C=R") && pending("RepairGeneration") && by(due("RepairGeneration"), generated_by());
    const Expr leaves = is("C=Q") && is(timed::leaving("Data")) &&
                        attempt_follows(is(timed::leaves("Data")) + suppression_);
    const Expr suppressed =
        is("C=S") && pending("SuppressionEnd") && attempt_follows(due("SuppressionEnd"));
    say("what is missing is on its way, or asked for, or an attempt will ask for it, in time",
        if_then(missing_, arrives_by("Data", received_by()) || ((is("C=A") || is("C=U")) && asks) ||
                              (is("C=U") && answered) || requested || leaves || suppressed));
  }
  /// An attempt after that time comes by the limit.
  [[nodiscard]] Expr attempt_follows(const Expr& time) const {
    return by(system_.next_attempt(time, is(watched::opened)), limit_);
  }
  /// When the ACKNACK to the HEARTBEAT that an attempt before the limit calls for has arrived.
  [[nodiscard]] Expr requested_by() const { return limit_ + delta_ + delta_ + response_ + delta_; }
  [[nodiscard]] Expr generated_by() const { return requested_by() + nack_; }
  [[nodiscard]] Expr received_by() const { return limit_ + system_.bound().exchange.expr(); }

  Expr response_;
  Expr nack_;
  Expr suppression_;
  Expr delta_;
  Expr limit_;
  Expr reader_open_;
  Expr waiting_;
  Expr missing_;
};

std::string name_of(Before before) {
  return before == Before::stale ? "live.recovery.stale.rules" : "live.recovery.fresh.rules";
}

/// What is shown is no weaker than the property, whatever the times are.
void compare_with_property(Proof& proof, const TimedDescriptor& descriptor, bool double_distances) {
  const smt::SymbolicInt opened = smt::SymbolicInt::named("opened");
  const smt::SymbolicInt failed = smt::SymbolicInt::named("failed");
  const smt::SymbolicInt stated =
      failed + recovery_after<smt::Symbolic>(descriptor.delays(),
                                             smt::SymbolicInt{descriptor.initial()},
                                             failed - opened, double_distances);
  const Expr shown =
      descriptor.next_attempt(failed.expr() + descriptor.bound().loss.expr(), opened.expr()) +
      descriptor.bound().exchange.expr();
  Exprs conditions = descriptor.assumptions();
  conditions.push_back(0 <= opened.expr() && opened.expr() <= failed.expr());
  conditions.push_back(shown > stated.expr());
  if (proof.possible("what is shown is later than B", conditions)) {
    proof.give_up("B of the property can be shorter than what is shown");
  }
}

props::Finding decided(const checker::CheckRequest& request, Before before,
                       const Tighter& tighter) {
  Proof proof{name_of(before), request};
  const model::DdsProfile& dds = proof.scenario().dds;
  assume_in_time(proof);
  proof.assume("0 < τ_I: readers ask by themselves.");
  proof.assume("From the opening of the reader's side on neither side forgets the other.");
  if (before == Before::stale) {
    proof.assume(
        "Nothing of an earlier life is under way or due when the writer holds as up to date a "
        "reader that has forgotten it.");
  }
  const TimedDescriptor descriptor{
      dds,
      proof.mistakes(),
      {.attempts = true, .stale = before == Before::stale, .tighten = tightened_by(tighter)}};
  proof.detail(
      "limit: by when the attempt after the opening is due; a loss at t moves it to the attempt "
      "after t + σ + τ_S; F = 4Δ + τ_A + τ_N");
  Certificate certificate = certificate_of(descriptor, Recovery{descriptor, dds});
  give(certificate, "0 < τ_I", descriptor.initial() >= 1);
  prove(proof, certificate);
  compare_with_property(proof, descriptor, doubles(dds));
  return proof.finish(
      std::string{"invariant over the steps that are derived from the amended rules, "
                  "from a writer that "} +
      (before == Before::stale ? "believes its reader to be up to date"
                               : "knows nothing of its reader") +
      ", with all timers and delays symbolic");
}

/// Why the certificates say nothing about the deployment; empty: they do.
std::string why_not_certified(const CheckRequest& request) {
  if (request.mutant != nullptr) return "with mistakes, runs say more";
  const model::Scenario& scenario = request.scenario;
  if (scenario.dds.sedp.initial_acknack_delay.count() == 0) return "no reader asks by itself";
  const auto& life = scenario.deployment.life;
  if (!life) return "nobody forgets, fails or comes back in this deployment";
  if (life->lease || !life->leases.empty() || !life->restarts.empty()) {
    return "somebody can forget or come back while it runs";
  }
  if (!life->endpoints.empty()) return "endpoints are created or deleted while it runs";
  return {};
}

}  // namespace

props::Finding recovery_certificate(const checker::CheckRequest& request, Before before,
                                    const Tighter& mistake) {
  if (mistake != Tighter{}) return decided(request, before, mistake);
  return checker::known(request, name_of(before), [&] { return decided(request, before, {}); });
}

Finding live_recovery(const CheckRequest& request) {
  return of_certificates(
      request, "certificates from the amended rules", why_not_certified(request),
      {"Any finite number of packets is lost.",
       "B counts from the last failure or from when both sides of the relation are open, whichever "
       "comes last: that participants recognise each other is not part of the proof.",
       "Of participants that are silent nothing is said."},
      [&] {
        std::vector parts{recovery_certificate(request, Before::fresh)};
        if (!request.scenario.deployment.life->stale.empty()) {
          parts.push_back(recovery_certificate(request, Before::stale));
        }
        return parts;
      });
}

}  // namespace stormproof::tables
