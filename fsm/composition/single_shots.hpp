// Asking a single-shot timer, and its being due: how Fast DDS schedules everything that it may be
// asked for again before it happens.
#pragma once

#include "fsm/composition/packets.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::fsm::composition {

/// No delay at all.
struct Immediately : FixedDelay<0> {};

/// Asks the timer `Shot`; `DueTimer` is due after `After` if it was idle.
template <class Shot, class After, class DueTimer, class W>
void request(W& w) {
  const auto shot =
      w.feed(Shot{}, on<single_shot::Requested>, {.now = w(Now{}), .delay = w(After{})});
  w.when(shot.schedule, [&] { w.at(shot.next_at, DueTimer{}); });
}

/// The timer is due: what was asked for happens.
template <class Shot, class W, class Body>
void expire(W& w, Body&& body) {
  const auto shot = w.feed(Shot{}, on<single_shot::Due>);
  w.when(shot.fire, body);
}

}  // namespace stormproof::fsm::composition
