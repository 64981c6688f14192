// order.total: (time, class, insertion) is a strict total order on events, so "the next event" is
// always one event. The sentence in the paper that orders same-time events does not say so much:
// read for each pair of events on its own it is not transitive, and then there may be no next event
// at all. The proof shows the three events.
#include "checker/engines/tables/event_order_rules.hpp"
#include "checker/engines/tables/properties.hpp"

namespace stormproof::tables {
namespace {

using checker::OrderRule;

std::string event_text(const z3::model& model, const SymbolicEvent& event, OrderRule rule) {
  const std::string insertion = " (insertion " + value_text(model, event.insertion.expr()) + ")";
  if (rule == OrderRule::pairwise_prose) {
    const auto role = std::stoi(value_text(model, event.role.expr()));
    return name_of(static_cast<Role>(role)) + insertion;
  }
  return "event at " + value_text(model, event.time.expr()) + " ns in class " +
         value_text(model, event.event_class.expr()) + insertion;
}

struct Events {
  SymbolicEvent a = SymbolicEvent::named("a");
  SymbolicEvent b = SymbolicEvent::named("b");
  SymbolicEvent c = SymbolicEvent::named("c");

  /// Any three events with distinct insertion numbers.
  [[nodiscard]] Expr valid() const {
    const auto distinct =
        a.insertion != b.insertion && b.insertion != c.insertion && a.insertion != c.insertion;
    return a.valid() && b.valid() && c.valid() && distinct.expr();
  }
};

/// A law of strict total orders: no `count` events refute it.
struct Law {
  const char* name;
  std::size_t count;
  const char* refuted;  ///< what the events do that refute it
};

void check_law(Proof& proof, const Events& events, OrderRule rule, const Law& law,
               const Exprs& refutation) {
  const auto decision = proof.ask(law.name, refutation);
  if (decision.answer == smt::Answer::unsat) {
    proof.detail(std::string{law.name} + ": holds for all events");
  }
  if (decision.answer != smt::Answer::sat) return;
  const SymbolicEvent* const involved[] = {&events.a, &events.b, &events.c};
  std::string text = std::string{law.name} + " fails: ";
  for (std::size_t k = 0; k < law.count; ++k) {
    text += event_text(*decision.model, *involved[k], rule) + (k + 1 < law.count ? ", " : ": ");
  }
  proof.violate(text + law.refuted);
}

/// The cycle in the pairwise reading: it must exist, or what we say about the paper is wrong.
void show_cycle(Proof& proof, const Events& events) {
  const auto rule = OrderRule::pairwise_prose;
  const Expr same_time = (events.a.time == events.b.time && events.b.time == events.c.time).expr();
  const auto decision =
      proof.ask("the pairwise reading has a cycle of three same-time events",
                {events.valid(), same_time, before(rule, events.a, events.b),
                 before(rule, events.b, events.c), before(rule, events.c, events.a)});
  if (decision.answer == smt::Answer::sat) {
    const z3::model& model = *decision.model;
    const std::string first = event_text(model, events.a, rule);
    proof.detail(
        "the pairwise reading of \"receptions before decisions, the channel last, "
        "otherwise in order of insertion\" is not transitive: " +
        first + " < " + event_text(model, events.b, rule) + " < " +
        event_text(model, events.c, rule) + " < " + first);
  } else if (decision.answer == smt::Answer::unsat) {
    proof.violate("the pairwise reading was expected to have a cycle, but has none");
  }
}

}  // namespace

Finding order_total(const CheckRequest& request) {
  Proof proof{"order.total", request};
  const OrderRule rule = order_rule(request);
  const Events events;
  const Expr a_b = before(rule, events.a, events.b);
  const Expr b_a = before(rule, events.b, events.a);
  const Expr b_c = before(rule, events.b, events.c);
  const Expr a_c = before(rule, events.a, events.c);
  proof.assume("Insertion numbers are distinct and below 2^62: one counter hands them out.");
  check_law(proof, events, rule, {"irreflexive", 1, "it comes before itself"},
            {events.a.valid(), before(rule, events.a, events.a)});
  check_law(proof, events, rule, {"asymmetric", 2, "each comes before the other"},
            {events.valid(), a_b, b_a});
  check_law(proof, events, rule,
            {"transitive", 3,
             "the first comes before the second, that before the third, but the first does not "
             "come before the third"},
            {events.valid(), a_b, b_c, !a_c});
  check_law(proof, events, rule, {"total", 2, "neither comes before the other"},
            {events.valid(), !a_b, !b_a});
  show_cycle(proof, events);
  return proof.finish(
      "the four laws of a strict total order, for the comparison that the event "
      "queue executes");
}

}  // namespace stormproof::tables
