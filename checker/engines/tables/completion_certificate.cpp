// The invariants over the rules' steps. While a descriptor is missing, its state
// at the writer says what is under way, and the ghost `limit` by when: an expiry that finds it in U
// comes by `limit`, and each packet and timer of the exchange after it as much later as it may
// take. A loss raises the limit by L (checker/engines/bounds/loss_bound.hpp); that this is enough
// is what the conditions decide.
#include "checker/engines/tables/completion_certificate.hpp"

#include <string>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/timed_certificate.hpp"

namespace stormproof::tables {
namespace {

class Invariant : public TimedStatement {
 public:
  Invariant(const TimedDescriptor& system, const model::DdsProfile& dds)
      : TimedStatement{system},
        period_{system.delays().period.expr()},
        response_{system.delays().response.expr()},
        nack_{system.delays().nack.expr()},
        suppression_{system.delays().suppression.expr()},
        delta_{system.delays().delta.expr()},
        asked_{is(timed::limit) + delta_ + response_ + delta_},
        generated_{asked_ + nack_},
        received_{is(timed::limit) + system.bound().exchange.expr()},
        counts_{is(watched::counting) && !is("X")} {
    say("only what is received is in A", if_then(is("C=A"), is("X")));
    for (const char* packet : {"Heartbeat", "AckNack", "Data"}) arrives_in_time(packet);
    within("HeartbeatExpiry", pending("HeartbeatExpiry") >= 1, period_);
    within("AckNackGeneration", pending("AckNackGeneration"), response_);
    within("SuppressionEnd", pending("SuppressionEnd"), suppression_);
    say("an expiry is pending, and only one, exactly while the timer is armed",
        is("pending HeartbeatExpiry") == z3::ite(is("HeartbeatClock=Armed"), number(1), number(0)));
    say("what can be asked for counts, and nothing else",
        is(watched::counting) == can_be_asked_for(dds, [&](const char* name) { return is(name); }));
    model::visit_engine_composition(dds, [&](auto composition) { add(composition); });
    conclude();
  }

 private:
  void add(model::Of<fsm::composition::paper::Paper>) {
    const Expr open = is("WriterOpen");
    within("RepairGeneration", pending("RepairGeneration"), nack_);
    repairs_leave_in_time();
    say("open and not in A: the timer is armed",
        if_then(open && !is("C=A"), is("HeartbeatClock=Armed")));
    waits_ = open && !is("C=A");
    waits_words_ = "open and not in A";
    missing(answer(is("C=U"), true_()) || repaired(is("C=R"), "RepairGeneration") ||
            (is("C=Q") && is(timed::leaving("Data")) &&
             by(is(timed::leaves("Data")), is(timed::limit) - period_ - suppression_)));
  }
  void add(model::Of<fsm::composition::fastdds::FastDds>) {
    within("NackResponseDue", is("pending NackResponseDue"), nack_);
    within("AsyncRunDue", is("pending AsyncRunDue"), number(0));
    say("what is not absent exists, and is open to the reader",
        if_then(!is("C=Absent"), is("WriterOpen") && is("Exists")));
    say("U: the timer is armed", if_then(is("C=U"), is("HeartbeatClock=Armed")));
    say("Q: it is in the queue", if_then(is("C=Q"), is("Enqueued") && is("AsyncRun=Pending")));
    say("R: the nack response is asked for", if_then(is("C=R"), is("NackResponse=Pending")));
    say("S: an end of suppression is asked for", if_then(is("C=S"), is("Suppression=Pending")));
    for (const auto& [part, timer] :
         {std::pair{"NackResponse", "NackResponseDue"}, std::pair{"AsyncRun", "AsyncRunDue"},
          std::pair{"Suppression", "SuppressionEnd"}, std::pair{"Reply", "AckNackGeneration"}}) {
      say(std::string{part} + ": what is asked for is pending, and nothing else",
          is(std::string{part} + "=Pending") == is(std::string{"pending "} + timer));
    }
    waits_ = is("C=U");
    waits_words_ = "in U";
    missing(answer(is("C=U"), is("Known")) || repaired(is("C=R"), "NackResponseDue") ||
            repaired(is("C=Q"), "AsyncRunDue"));
  }

  /// While the descriptor is missing: its DATA is on its way, or it is in S, or `case_of_writer`.
  void missing(const Expr& case_of_writer) {
    const Expr data = arrives_by("Data", received_);
    const Expr suppressed = is("C=S") && is("pending SuppressionEnd") &&
                            by(due("SuppressionEnd"), is(timed::limit) - period_);
    say("what is missing is on its way, or something is pending that asks for it, in time",
        if_then(counts_, data || suppressed || case_of_writer));
  }
  /// In U: an expiry is due, or an exchange is under way.
  Expr answer(const Expr& in_state, const Expr& known) {
    const Expr limit = is(timed::limit);
    return in_state && ((pending("HeartbeatExpiry") >= 1 && by(due("HeartbeatExpiry"), limit)) ||
                        arrives_by("Heartbeat", limit + delta_) ||
                        (known && pending("AckNackGeneration") &&
                         by(due("AckNackGeneration"), limit + delta_ + response_)) ||
                        arrives_by("AckNack", asked_));
  }
  Expr repaired(const Expr& in_state, const std::string& timer) {
    return in_state && is("pending " + timer) && by(due(timer), generated_);
  }

  void conclude() {
    const Expr expiry = pending("HeartbeatExpiry") >= 1;
    conclusions.push_back({waits_words_ + ": an expiry is pending within τ_H",
                           if_then(waits_, expiry && now() <= due("HeartbeatExpiry") &&
                                               by(due("HeartbeatExpiry"), now() + period_))});
    on_steps.push_back({"an expiry that finds it " + waits_words_ + " sends to its reader",
                        "HeartbeatExpires", waits_, is(watched::heartbeat_sent) == now()});
    conclusions.push_back(
        {"what is missing is received by the limit + F", if_then(counts_, by(now(), received_))});
  }

  Expr period_;
  Expr response_;
  Expr nack_;
  Expr suppression_;
  Expr delta_;
  Expr asked_;      ///< when an ACKNACK of the exchange after `limit` has arrived
  Expr generated_;  ///< and when the repair that it asks for is generated
  Expr received_;   ///< and when it has arrived
  Expr counts_;
  Expr waits_{true_()};  ///< the writer waits for it to be acknowledged or asked for
  std::string waits_words_;
};

constexpr const char* certificate_name = "live.completion.rules";

props::Finding decided(const checker::CheckRequest& request, const Tighter& tighter) {
  Proof proof{certificate_name, request};
  const model::DdsProfile& dds = proof.scenario().dds;
  const std::string how = "invariant over the steps that are derived from the rules";
  const std::string why = not_certified(dds);
  if (!why.empty()) {
    proof.give_up(why);
    return proof.finish(how);
  }
  assume_in_time(proof);
  const TimedDescriptor descriptor{dds, proof.mistakes(), {.tighten = tightened_by(tighter)}};
  return proved(proof, certificate_of(descriptor, Invariant{descriptor, dds}),
                how + ", with all timers and delays symbolic");
}

}  // namespace

std::string not_certified(const model::DdsProfile& dds) {
  if (dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) {
    return "the adaptive policy has no fixed period";
  }
  if (model::rules_of(dds).heartbeat_timer == model::HeartbeatTimerKind::additive) {
    return "with additive timers the certificate follows no single expiry";
  }
  return {};
}

props::Finding completion_certificate(const checker::CheckRequest& request,
                                      const Tighter& mistake) {
  if (mistake != Tighter{}) return decided(request, mistake);
  return checker::known(request, certificate_name, [&] { return decided(request, {}); });
}

}  // namespace stormproof::tables
