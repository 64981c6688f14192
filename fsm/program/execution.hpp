// What an execution of a program remembers (fsm/program/interpreter.hpp): values over the domain of
// its reader, and which register has which.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "fsm/program/program.hpp"

namespace stormproof::fsm::program {

/// A truth value, a number or a set; nothing is false, 0 and empty.
template <class Bool, class Int, class Set>
class AnyValue {
 public:
  AnyValue() = default;
  AnyValue(Bool value) : value_{std::in_place_index<1>, std::move(value)} {}
  AnyValue(Int value) : value_{std::in_place_index<2>, std::move(value)} {}
  AnyValue(Set value) requires(!std::is_same_v<Set, Bool>)
      : value_{std::in_place_index<3>, std::move(value)} {}

  [[nodiscard]] bool is_number() const { return value_.index() == 2; }
  [[nodiscard]] Bool truth() const { return is_nothing() ? Bool(false) : std::get<1>(value_); }
  [[nodiscard]] Int number() const { return is_nothing() ? Int(0) : std::get<2>(value_); }
  [[nodiscard]] Set set() const {
    if constexpr (std::is_same_v<Set, Bool>) {
      return truth();
    } else {
      return is_nothing() ? Set{} : std::get<3>(value_);
    }
  }

 private:
  [[nodiscard]] bool is_nothing() const { return value_.index() == 0; }

  // A reader whose sets are truth values has no third kind.
  struct None {};
  std::variant<std::monostate, Bool, Int, std::conditional_t<std::is_same_v<Set, Bool>, None, Set>>
      value_;
};

/// What an operator makes of two numbers.
template <class Result, class Int>
Result of_numbers(Op op, const Int& a, const Int& b) {
  switch (op) {
    case Op::plus:
      return a + b;
    case Op::minus:
      return a - b;
    case Op::times:
      return a * b;
    case Op::over:
      return a / b;
    case Op::equal:
      return a == b;
    case Op::unequal:
      return a != b;
    case Op::less:
      return a < b;
    case Op::at_most:
      return a <= b;
    case Op::greater:
      return a > b;
    default:
      return a >= b;
  }
}

/// What all places of an execution share.
template <class Value>
struct Execution {
  const Program& program;
  const std::vector<composition::EffectMutation>& mistakes;
  std::vector<std::vector<Value>> registers =
      std::vector<std::vector<Value>>(program.registers.size());
  std::function<void()> deferred{};  ///< an effect that comes after the next one
};

}  // namespace stormproof::fsm::program
