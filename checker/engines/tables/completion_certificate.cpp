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

Expr if_then(const Expr& condition, const Expr& consequence) {
  return z3::implies(condition, consequence);
}

class Invariant {
 public:
  Invariant(const TimedDescriptor& system, const model::DdsProfile& dds)
      : system_{system},
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
    for (const char* packet : {"Heartbeat", "AckNack", "Data"}) {
      say(std::string{packet} + ": what is looked at arrives within Δ",
          if_then(is(timed::in_flight(packet)), by(is(timed::arrives(packet)), now() + delta_)));
    }
    within("HeartbeatExpiry", is("pending HeartbeatExpiry") >= 1, period_);
    within("AckNackGeneration", is("pending AckNackGeneration"), response_);
    within("SuppressionEnd", is("pending SuppressionEnd"), suppression_);
    say("an expiry is pending, and only one, exactly while the timer is armed",
        is("pending HeartbeatExpiry") == z3::ite(is("HeartbeatClock=Armed"), number(1), number(0)));
    say("what can be asked for counts, and nothing else",
        is(watched::counting) == can_be_asked_for(dds, [&](const char* name) { return is(name); }));
    model::visit_engine_composition(dds, [&](auto composition) { add(composition); });
    conclude();
  }

  std::vector<Clause> stated;
  std::vector<Clause> conclusions;
  std::vector<StepClause> on_steps;

 private:
  void add(model::Of<fsm::composition::paper::Paper>) {
    const Expr open = is("WriterOpen");
    within("RepairGeneration", is("pending RepairGeneration"), nack_);
    say("a repair that is looked at leaves its source within σ",
        if_then(is(timed::leaving("Data")),
                by(is(timed::leaves("Data")), now() + system_.delays().source.expr())));
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
    const Expr data = is(timed::in_flight("Data")) && by(is(timed::arrives("Data")), received_);
    const Expr suppressed = is("C=S") && is("pending SuppressionEnd") &&
                            by(due("SuppressionEnd"), is(timed::limit) - period_);
    say("what is missing is on its way, or something is pending that asks for it, in time",
        if_then(counts_, data || suppressed || case_of_writer));
  }
  /// In U: an expiry is due, or an exchange is under way.
  Expr answer(const Expr& in_state, const Expr& known) {
    const Expr limit = is(timed::limit);
    return in_state &&
           ((is("pending HeartbeatExpiry") >= 1 && by(due("HeartbeatExpiry"), limit)) ||
            (is(timed::in_flight("Heartbeat")) &&
             by(is(timed::arrives("Heartbeat")), limit + delta_)) ||
            (known && is("pending AckNackGeneration") &&
             by(due("AckNackGeneration"), limit + delta_ + response_)) ||
            (is(timed::in_flight("AckNack")) && by(is(timed::arrives("AckNack")), asked_)));
  }
  Expr repaired(const Expr& in_state, const std::string& timer) {
    return in_state && is("pending " + timer) && by(due(timer), generated_);
  }

  void conclude() {
    const Expr expiry = is("pending HeartbeatExpiry") >= 1;
    conclusions.push_back({waits_words_ + ": an expiry is pending within τ_H",
                           if_then(waits_, expiry && now() <= due("HeartbeatExpiry") &&
                                               by(due("HeartbeatExpiry"), now() + period_))});
    on_steps.push_back({"an expiry that finds it " + waits_words_ + " sends to its reader",
                        "HeartbeatExpires", waits_, is(watched::heartbeat_sent) == now()});
    conclusions.push_back(
        {"what is missing is received by the limit + F", if_then(counts_, by(now(), received_))});
  }

  void say(std::string words, const Expr& holds) { stated.push_back({std::move(words), holds}); }
  void within(const std::string& timer, const Expr& pending, const Expr& delay) {
    say(timer + ": what is pending is due within its delay",
        if_then(pending, now() <= due(timer) && by(due(timer), now() + delay)));
  }
  [[nodiscard]] Expr is(const std::string& name) const { return system_[name]; }
  [[nodiscard]] Expr due(const std::string& timer) const { return is(timed::due(timer)); }
  [[nodiscard]] Expr now() const { return is(timed::now); }
  static Expr by(const Expr& time, const Expr& latest) { return time <= latest; }
  static Expr number(int value) { return smt::SymbolicContext::current().int_val(value); }
  static Expr true_() { return smt::SymbolicContext::current().bool_val(true); }

  const TimedDescriptor& system_;
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

Certificate certificate_of(const TimedDescriptor& descriptor, const Invariant& invariant) {
  const Moving moving{descriptor.whole()};
  Certificate certificate = certificate_in_time(descriptor, moving);
  const auto add = [&](const std::vector<Clause>& from, std::vector<Clause>& to) {
    for (const Clause& clause : from) to.push_back({clause.words, moving(clause.holds)});
  };
  add(invariant.stated, certificate.invariant);
  add(invariant.conclusions, certificate.conclusions);
  for (const StepClause& clause : invariant.on_steps) {
    certificate.on_steps.push_back(
        {clause.words, clause.step, moving(clause.before), moving(clause.after)});
  }
  return certificate;
}

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
  const TimedDescriptor descriptor{dds, proof.mistakes(), {.tighten = [&](auto& bound) {
                                     bound.first = bound.first - tighter.first;
                                     bound.loss = bound.loss - tighter.loss;
                                     bound.exchange = bound.exchange - tighter.exchange;
                                   }}};
  prove(proof, certificate_of(descriptor, {descriptor, dds}));
  return proof.finish(how + ", with all timers and delays symbolic");
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

props::Finding completion_certificate(const checker::CheckRequest& request) {
  return checker::known(request, certificate_name, [&] { return decided(request, {}); });
}

props::Finding tighter_certificate(const checker::CheckRequest& request, const Tighter& tighter) {
  return decided(request, tighter);
}

}  // namespace stormproof::tables
