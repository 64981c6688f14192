// The domain of Promela text: truth values and numbers as expressions over the variables of a
// model. What is constant is folded, so that a knob that is off leaves nothing behind. Times are
// not in a model: a number that depends on one is unknown. An expression remembers which variables
// it reads, and how often each had been written by then: said after one of them has changed, it
// would be another value (see checker/engines/promela/script.hpp).
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stormproof::promela {

/// Variables, and how often each had been written when it was read.
using Reads = std::map<std::string, unsigned>;

/// What truth values and numbers have in common.
struct Expression {
  std::string text;  ///< empty: unknown
  std::optional<std::int64_t> constant{};
  Reads reads{};
};

/// `word` between two expressions; `fold` is what it does to constants.
[[nodiscard]] Expression joined(const Expression& a, std::string_view word, const Expression& b,
                                std::int64_t (*fold)(std::int64_t, std::int64_t));

class Truth {
 public:
  Truth() : Truth{false} {}
  template <std::same_as<bool> T>
  Truth(T value) : of_{value ? "true" : "false", value ? 1 : 0} {}
  explicit Truth(Expression of) : of_{std::move(of)} {}

  [[nodiscard]] const Expression& expression() const { return of_; }
  [[nodiscard]] bool is(bool value) const { return of_.constant == (value ? 1 : 0); }

  friend Truth operator!(const Truth& a);
  friend Truth operator&&(const Truth& a, const Truth& b);
  friend Truth operator||(const Truth& a, const Truth& b);

 private:
  Expression of_;
};

class Number {
 public:
  Number() : Number{0} {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) Number(T value) : of_{std::to_string(value), value} {}
  explicit Number(Expression of) : of_{std::move(of)} {}
  [[nodiscard]] static Number unknown() { return Number{Expression{""}}; }
  /// 1 if it holds, otherwise 0.
  [[nodiscard]] static Number of(const Truth& truth);

  [[nodiscard]] const Expression& expression() const { return of_; }

  friend Number operator+(const Number& a, const Number& b);
  friend Number operator-(const Number& a, const Number& b);
  friend Number operator*(const Number& a, const Number& b);
  friend Number operator/(const Number& a, const Number& b);
  friend Truth operator==(const Number& a, const Number& b);
  friend Truth operator!=(const Number& a, const Number& b) { return !(a == b); }
  friend Truth operator<(const Number& a, const Number& b);
  friend Truth operator<=(const Number& a, const Number& b) { return !(b < a); }
  friend Truth operator>(const Number& a, const Number& b) { return b < a; }
  friend Truth operator>=(const Number& a, const Number& b) { return !(a < b); }

 private:
  Expression of_;
};

struct Written {
  using Bool = Truth;
  using Int = Number;

  [[nodiscard]] static Number select(const Truth& condition, const Number& then,
                                     const Number& otherwise);
};

/// A truth value for each descriptor.
struct Lanes {
  std::vector<Truth> of;

  /// Bit d is lane d.
  [[nodiscard]] Number bitmap() const;
  [[nodiscard]] Truth any() const;
};
/// The domain of an outbox of all descriptors.
struct LaneDomain {
  using Bool = Lanes;
  struct Int {};
};

}  // namespace stormproof::promela
