// How often a descriptor can be asked for without need, with all timers and delays symbolic.
#include "checker/engines/calculus/cannot_start.hpp"
#include "checker/engines/calculus/closed_loop.hpp"
#include "checker/engines/timeline/theorem.hpp"

namespace stormproof::calculus {

namespace {

using timeline::Int;
using timeline::Theorem;

/// DATA leaves at 0. An ACKNACK lists it only if it is generated before the DATA arrives: one at
/// the same instant comes after.
void prove_window_of_pushed(Theorem& t) {
  const std::size_t mark = t.open();
  const Int delay = t.at_least("delay_bound", 0);
  const Int response = t.at_least("tau_A", 0);
  const Int data = t.within("data_delay", 0, delay);
  const Int sent = t.at_least("heartbeat_sent", 0);
  const Int heartbeat = t.within("heartbeat_delay", 0, delay);
  t.assume(sent + heartbeat + response < data);
  t.holds("a HEARTBEAT whose ACKNACK asks for pushed DATA leaves within D − 1 − τ_A",
          sent <= delay - 1 - response);
  t.close(mark);
}

/// The first ACKNACK that lists a descriptor is generated at 0.
void prove_window_of_pulled(Theorem& t) {
  const std::size_t mark = t.open();
  const Int delay = t.at_least("delay_bound", 0);
  const Int nack = t.at_least("tau_N", 0);
  const Int arrives = t.within("first_acknack_delay", 0, delay);
  const Int serialized = t.within("first_serialized", 0, arrives + nack);
  const Int received = serialized + t.within("data_delay", 0, delay);
  const Int later = t.at_least("generated_later", 0);
  t.assume(later < received);
  t.holds("ACKNACKs that list a descriptor are generated within 2D + τ_N",
          later <= delay + delay + nack - 1);
  const Int asked = later + t.within("later_delay", 0, delay);
  const Int answered = t.within("answered", asked, asked + nack);
  t.holds("its copies are sent within 2D + τ_N of the first one",
          answered - serialized <= delay + delay + nack - 1);
  const Int ends = t.at_least("suppressions", 0);  // k·τ_S, as a ghost: k of them, one by one
  t.assume(serialized + ends < asked);
  t.holds("no more suppressions end in between than 2D − 2 has room for",
          ends <= delay + delay - 2);
  t.close(mark);
}

}  // namespace

void prove_closed_loop(Theorem& theorem, const ClosedLoop& loop) {
  prove_lemmas(theorem, Lemma::none);
  prove_window_of_pushed(theorem);
  prove_window_of_pulled(theorem);
  if (loop.busy) prove_numbers(theorem, loop.traffic, *loop.busy, *loop.delay);
}

}  // namespace stormproof::calculus
