// timer.single-heartbeat: a writer never has two HEARTBEAT expiries pending; under the adaptive
// policy, never two cycle events that are not void. The periodic policy is a question to the
// derived system; the adaptive one to the table of the timer together with the number of events
// that are in the queue for it, because the arithmetic of its periods would be in the way.
#include "checker/engines/tables/machine_step.hpp"
#include "checker/engines/tables/properties.hpp"
#include "checker/engines/tables/safety_certificate.hpp"
#include "checker/engines/tables/transition_system.hpp"
#include "fsm/heartbeat_timer.hpp"

namespace stormproof::tables {
namespace {

namespace timer = fsm::heartbeat_timer;
using Timer = MachineStep<fsm::HeartbeatTimer>;
using model::EventKind;
using smt::SymbolicBool;
using smt::SymbolicInt;

/// How many events get into the queue when one is scheduled: 1 without a mistake.
int copies(const model::Mutation& mistakes, EventKind kind) {
  int result = 1;
  for (const model::EventMutation& mistake : mistakes.events) {
    if (mistake.kind != kind) continue;
    if (mistake.change == model::EventMutation::Change::forget) result = 0;
    if (mistake.change == model::EventMutation::Change::duplicate) result = 2;
  }
  return result;
}

Expr number(int value) { return smt::SymbolicContext::current().int_val(value); }
Expr yes() { return smt::SymbolicContext::current().bool_val(true); }

class Adaptive {
 public:
  explicit Adaptive(Proof& proof)
      : timer_{proof.mistakes().tables},
        start_copies_{copies(proof.mistakes(), EventKind::cycle_start)},
        end_copies_{copies(proof.mistakes(), EventKind::cycle_end)} {}

  TransitionSystem build() {
    add<timer::ArmRequested>("a relation opens or something must be checked", yes(), 0, 0);
    add<timer::SuppressionEnded>("a suppression ends", yes(), 0, 0);
    add<timer::CycleStarted>("cycle start", starts_ >= 1, 1, 0);
    add<timer::CycleEnded>("cycle end", ends_ >= 1, 0, 1);
    add<timer::BatchDue>("batch", yes(), 0, 0);
    add<timer::ResponseReceived>("response", yes(), 0, 0);
    Exprs variables = state_;
    variables.insert(variables.end(), {starts_, ends_});
    return {variables, Timer::is_initial(state_) && starts_ == 0 && ends_ == 0, steps_,
            starts_ + ends_ >= 2};
  }

 private:
  template <class Event>
  void add(const std::string& name, const Expr& guard, int starts_fired, int ends_fired) {
    const SymbolicBool unacknowledged = SymbolicBool::named("unacknowledged");
    const SymbolicBool last = SymbolicBool::named("last_response_in_time");
    Timer::Input input;
    input.adaptive = true;
    input.unacknowledged = unacknowledged;
    // The cycle matters only through AllInTime, which these values make true or false at will.
    input.cycle.contacted = 1;
    input.cycle.period = SymbolicInt{z3::ite(last.expr(), number(1), number(0))};
    const auto effect = timer_.step<Event>(state_, input, yes());
    const Expr void_now = effect.asks(&Timer::Output::invalidate);
    const auto after = [&](const Expr& before, const Expr& scheduled, int count) {
      return z3::ite(void_now, number(0), before) + z3::ite(scheduled, number(count), number(0));
    };
    Exprs next = effect.next;
    next.push_back(
        after(starts_ - starts_fired, effect.asks(&Timer::Output::schedule_cycle), start_copies_));
    next.push_back(
        after(ends_ - ends_fired, effect.asks(&Timer::Output::schedule_end), end_copies_));
    steps_.push_back({name, {unacknowledged.expr(), last.expr()}, guard, next});
  }

  Timer timer_;
  int start_copies_;
  int end_copies_;
  OneHot state_ = Timer::unknown_state("timer=");
  Expr starts_ = SymbolicInt::named("cycle_starts_pending").expr();
  Expr ends_ = SymbolicInt::named("cycle_ends_pending").expr();
  std::vector<SystemStep> steps_;
};

}  // namespace

Finding timer_single_heartbeat(const CheckRequest& request) {
  Proof proof{"timer.single-heartbeat", request};
  proof.assume("A scheduled event fires once: the event queue hands out each event once.");
  if (proof.scenario().dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) {
    proof.assume(
        "Relations open, suppressions end and responses come at any time, whether or not "
        "something is unacknowledged.");
    return proof.finish(
        prove_unreachable(proof, Adaptive{proof}.build(),
                          "two cycle events of a writer are pending that are not void"));
  }
  const DescriptorSystem descriptor = descriptor_system(proof);
  const Expr& pending = descriptor["pending HeartbeatExpiry"];
  const Expr once = z3::ite(descriptor["HeartbeatClock=Armed"], number(1), number(0));
  return proof.finish(
      prove_never(proof, descriptor,
                  {{{"one expiry is pending while the timer is armed, and none "
                     "otherwise",
                     pending == once}},
                   {},
                   {{pending >= 2, "two HEARTBEAT expiries of a writer are pending"}}}));
}

}  // namespace stormproof::tables
