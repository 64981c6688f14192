// The domain of terms: rules, guards and actions are run once over it, and whatever they compute
// becomes a term of the program that is being recorded. A value is no `bool`, so no rule can decide
// by one, and one run sees everything.
#pragma once

#include <concepts>
#include <cstdint>

#include "fsm/program/program.hpp"

namespace stormproof::fsm::program {

class Value {
 public:
  Value() : Value{false} {}
  template <std::same_as<bool> T>
  Value(T value) : ref_{constant(Op::truth, value ? 1 : 0)} {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Value(T value)
      : ref_{constant(Op::integer, static_cast<std::int64_t>(value))} {}
  [[nodiscard]] static Value make(const Term& term) { return Value{Made{}, add(term)}; }

  [[nodiscard]] Ref ref() const { return ref_; }

  friend Value operator!(const Value& a) { return make({.op = Op::negation, .a = a.ref_}); }
  friend Value operator&&(const Value& a, const Value& b) { return joined(Op::both, a, b); }
  friend Value operator||(const Value& a, const Value& b) { return joined(Op::either, a, b); }
  friend Value operator+(const Value& a, const Value& b) { return joined(Op::plus, a, b); }
  friend Value operator-(const Value& a, const Value& b) { return joined(Op::minus, a, b); }
  friend Value operator*(const Value& a, const Value& b) { return joined(Op::times, a, b); }
  friend Value operator/(const Value& a, const Value& b) { return joined(Op::over, a, b); }
  friend Value operator==(const Value& a, const Value& b) { return joined(Op::equal, a, b); }
  friend Value operator!=(const Value& a, const Value& b) { return joined(Op::unequal, a, b); }
  friend Value operator<(const Value& a, const Value& b) { return joined(Op::less, a, b); }
  friend Value operator<=(const Value& a, const Value& b) { return joined(Op::at_most, a, b); }
  friend Value operator>(const Value& a, const Value& b) { return joined(Op::greater, a, b); }
  friend Value operator>=(const Value& a, const Value& b) { return joined(Op::at_least, a, b); }

 private:
  friend class Recording;
  struct Made {};
  Value(Made, Ref ref) : ref_{ref} {}
  static Value joined(Op op, const Value& a, const Value& b) {
    return make({.op = op, .a = a.ref_, .b = b.ref_});
  }
  static Ref add(const Term& term);
  static Ref constant(Op op, std::int64_t value);

  Ref ref_ = no_term;
};

/// The domain, for rules and machines alike (fsm/domain.hpp).
struct Terms {
  using Bool = Value;
  using Int = Value;

  static Value select(const Value& condition, const Value& then, const Value& otherwise) {
    return Value::make(
        {.op = Op::select, .a = condition.ref(), .b = then.ref(), .c = otherwise.ref()});
  }
};

/// While it lives, values that this thread makes are terms of `program`.
class Recording {
 public:
  explicit Recording(Program& program) : outer_{current_} { current_ = &program; }
  ~Recording() { current_ = outer_; }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

 private:
  friend class Value;
  Program* outer_;
  static thread_local Program* current_;
};

}  // namespace stormproof::fsm::program
