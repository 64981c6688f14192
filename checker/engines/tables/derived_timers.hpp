// A timer in a derived system: how often it is pending, as the rules count and as the queue does,
// when it is due if time plays a part, and what a mutant's mistakes make of that.
#pragma once

#include <algorithm>

#include "checker/engines/tables/derived.hpp"
#include "model/engine/timer_kinds.hpp"

namespace stormproof::tables {

/// Our own T, in the step that is being derived.
template <class T>
class DerivedTimer {
  using Int = smt::SymbolicInt;
  using Change = model::EventMutation::Change;

 public:
  explicit DerivedTimer(Derived& derived) : derived_{derived} {}

  /// How often T is scheduled, as the rules count: a variable of its own only if a mistake makes
  /// that differ from how often it is in the queue.
  [[nodiscard]] std::string counter() const {
    return (copies() == 1 ? "pending " : "counted ") + tag_name<T>();
  }

  void started(const Expr& when, const Int& due) {
    if (derived_.time != nullptr && copies() > 0) {
      derived_.time->started(tag_name<T>(), when, (due + late()).expr());
    }
    if (derived_.counts<T>()) {
      system().assign(pending(), when, system().now(pending()) + copies());
      if (counter() != pending()) {
        system().assign(counter(), when, system().now(counter()) + 1);
      }
    } else if (copies() > 0) {
      const Expr yes = smt::SymbolicBool{true}.expr();
      system().assign(pending(), when, yes);
      system().assign("started " + tag_name<T>(), when, yes);
    }
  }
  void cancelled(const Expr& when) {
    if (!derived_.counts<T>()) {
      return system().assign(pending(), when, smt::SymbolicBool{false}.expr());
    }
    const Expr none = Int{0}.expr();
    system().assign(pending(), when, none);
    system().assign(counter(), when, none);
  }
  /// It is due.
  void fires() {
    if (derived_.time != nullptr) derived_.time->fires(tag_name<T>());
    if (derived_.counts<T>()) {
      system().require(system().now(pending()) >= 1);
      system().now(pending()) = system().now(pending()) - 1;
      if (counter() == pending()) return;
      Expr& counted = system().now(counter());
      counted = z3::ite(counted > 0, counted - 1, counted);
    } else {
      system().require(system().now("started " + tag_name<T>()));
      // Nothing is surely pending any more.
      system().now(pending()) = smt::SymbolicBool{false}.expr();
    }
  }

 private:
  [[nodiscard]] Derivation& system() const { return derived_.derivation; }
  [[nodiscard]] static std::string pending() { return "pending " + tag_name<T>(); }
  /// How many events get into the queue when one is scheduled: 1 without a mistake.
  [[nodiscard]] int copies() const {
    int copies = 1;
    for (const model::EventMutation& mistake : derived_.mistakes.events) {
      if (mistake.kind != model::event_kind_of<T>) continue;
      if (mistake.change == Change::forget) copies = 0;
      if (mistake.change == Change::duplicate) copies = 2;
    }
    return copies;
  }
  /// How much later than the rules say, ns: 0 without a mistake.
  [[nodiscard]] Int late() const {
    Int late = 0;
    for (const model::EventMutation& mistake : derived_.mistakes.events) {
      if (mistake.kind != model::event_kind_of<T>) continue;
      if (mistake.change == Change::shift) late = mistake.by.count();
    }
    return late;
  }

  Derived& derived_;
};

}  // namespace stormproof::tables
