// A timer in a derived system: how often it is pending, as the rules count and as the queue does,
// when it is due if time plays a part, and what a mutant's mistakes make of that.
#pragma once

#include "checker/engines/tables/derived.hpp"
#include "model/engine/program_things.hpp"

namespace stormproof::tables {

/// Our own timer, in the step that is being derived.
class DerivedTimer {
  using Int = smt::SymbolicInt;
  using Change = model::EventMutation::Change;

 public:
  DerivedTimer(const fsm::program::Thing& timer, Derived& derived)
      : timer_{timer}, derived_{derived} {}

  /// How often it is scheduled, as the rules count: a variable of its own only if a mistake makes
  /// that differ from how often it is in the queue.
  [[nodiscard]] std::string counter() const {
    return (copies() == 1 ? "pending " : "counted ") + name();
  }

  void started(const Expr& when, const Int& due) {
    if (derived_.time != nullptr && copies() > 0) {
      derived_.time->started(name(), when, (due + late()).expr());
    }
    if (derived_.counts(timer_)) {
      system().assign(pending(), when, system().now(pending()) + copies());
      if (counter() != pending()) {
        system().assign(counter(), when, system().now(counter()) + 1);
      }
    } else if (copies() > 0) {
      const Expr yes = smt::SymbolicBool{true}.expr();
      system().assign(pending(), when, yes);
      system().assign("started " + name(), when, yes);
    }
  }
  void cancelled(const Expr& when) {
    if (!derived_.counts(timer_)) {
      return system().assign(pending(), when, smt::SymbolicBool{false}.expr());
    }
    const Expr none = Int{0}.expr();
    system().assign(pending(), when, none);
    system().assign(counter(), when, none);
  }
  /// It is due.
  void fires() {
    if (derived_.time != nullptr) derived_.time->fires(name());
    if (derived_.counts(timer_)) {
      system().require(system().now(pending()) >= 1);
      system().now(pending()) = system().now(pending()) - 1;
      if (counter() == pending()) return;
      Expr& counted = system().now(counter());
      counted = z3::ite(counted > 0, counted - 1, counted);
    } else {
      system().require(system().now("started " + name()));
      // Nothing is surely pending any more.
      system().now(pending()) = smt::SymbolicBool{false}.expr();
    }
  }

 private:
  [[nodiscard]] Derivation& system() const { return derived_.derivation; }
  [[nodiscard]] std::string name() const { return std::string{timer_.name}; }
  [[nodiscard]] std::string pending() const { return "pending " + name(); }
  /// How many events get into the queue when one is scheduled: 1 without a mistake.
  [[nodiscard]] int copies() const {
    int copies = 1;
    for (const model::EventMutation& mistake : derived_.mistakes.events) {
      if (mistake.kind != model::event_kind(timer_)) continue;
      if (mistake.change == Change::forget) copies = 0;
      if (mistake.change == Change::duplicate) copies = 2;
    }
    return copies;
  }
  /// How much later than the rules say, ns: 0 without a mistake.
  [[nodiscard]] Int late() const {
    Int late = 0;
    for (const model::EventMutation& mistake : derived_.mistakes.events) {
      if (mistake.kind != model::event_kind(timer_)) continue;
      if (mistake.change == Change::shift) late = mistake.by.count();
    }
    return late;
  }

  const fsm::program::Thing& timer_;
  Derived& derived_;
};

}  // namespace stormproof::tables
