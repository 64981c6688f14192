// The domain of proofs: guards and actions of the machines evaluated over solver expressions. Truth
// values and integers are wrapped because the machines default-construct them (false, 0) and mix
// them with plain constants, which z3::expr does not allow without naming a context. The context
// is therefore that of the innermost living SymbolicContext of this thread.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>

#include <z3++.h>

namespace stormproof::smt {

/// While it lives, this thread makes symbolic values in `context`, which must outlive it.
class SymbolicContext {
 public:
  explicit SymbolicContext(z3::context& context) : outer_{current_} { current_ = &context; }
  ~SymbolicContext() { current_ = outer_; }
  SymbolicContext(const SymbolicContext&) = delete;
  SymbolicContext& operator=(const SymbolicContext&) = delete;

  /// The context of the innermost guard. There must be one.
  [[nodiscard]] static z3::context& current() { return *current_; }

 private:
  z3::context* outer_;
  static inline thread_local z3::context* current_ = nullptr;
};

/// A truth value.
class SymbolicBool {
 public:
  SymbolicBool() : SymbolicBool{false} {}
  template <std::same_as<bool> T>
  SymbolicBool(T value) : expr_{SymbolicContext::current().bool_val(value)} {}
  explicit SymbolicBool(z3::expr expr) : expr_{std::move(expr)} {}
  /// An unknown with this name.
  static SymbolicBool named(const std::string& name) {
    return SymbolicBool{SymbolicContext::current().bool_const(name.c_str())};
  }

  [[nodiscard]] const z3::expr& expr() const { return expr_; }

  friend SymbolicBool operator!(const SymbolicBool& a) { return SymbolicBool{!a.expr_}; }
  friend SymbolicBool operator&&(const SymbolicBool& a, const SymbolicBool& b) {
    return SymbolicBool{a.expr_ && b.expr_};
  }
  friend SymbolicBool operator||(const SymbolicBool& a, const SymbolicBool& b) {
    return SymbolicBool{a.expr_ || b.expr_};
  }
  friend SymbolicBool operator==(const SymbolicBool& a, const SymbolicBool& b) {
    return SymbolicBool{a.expr_ == b.expr_};
  }

 private:
  z3::expr expr_;
};

/// An integer without bounds. Division is Euclidean, which is that of C++ as long as neither side
/// is negative; the machines divide nothing else.
class SymbolicInt {
 public:
  SymbolicInt() : SymbolicInt{0} {}
  template <std::integral T>
  requires(!std::same_as<T, bool>) SymbolicInt(T value)
      : expr_{SymbolicContext::current().int_val(static_cast<std::int64_t>(value))} {}
  explicit SymbolicInt(z3::expr expr) : expr_{std::move(expr)} {}
  static SymbolicInt named(const std::string& name) {
    return SymbolicInt{SymbolicContext::current().int_const(name.c_str())};
  }

  [[nodiscard]] const z3::expr& expr() const { return expr_; }

  friend SymbolicBool operator==(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicBool{a.expr_ == b.expr_};
  }
  friend SymbolicBool operator!=(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicBool{a.expr_ != b.expr_};
  }
  friend SymbolicBool operator<(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicBool{a.expr_ < b.expr_};
  }
  friend SymbolicBool operator<=(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicBool{a.expr_ <= b.expr_};
  }
  friend SymbolicBool operator>(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicBool{a.expr_ > b.expr_};
  }
  friend SymbolicBool operator>=(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicBool{a.expr_ >= b.expr_};
  }
  friend SymbolicInt operator+(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicInt{a.expr_ + b.expr_};
  }
  friend SymbolicInt operator-(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicInt{a.expr_ - b.expr_};
  }
  friend SymbolicInt operator*(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicInt{a.expr_ * b.expr_};
  }
  friend SymbolicInt operator/(const SymbolicInt& a, const SymbolicInt& b) {
    return SymbolicInt{a.expr_ / b.expr_};
  }

 private:
  z3::expr expr_;
};

/// The domain, to be used as `D` where the machines say `template <class D>` (fsm/domain.hpp).
struct Symbolic {
  using Bool = SymbolicBool;
  using Int = SymbolicInt;

  static Int select(const Bool& condition, const Int& then, const Int& otherwise) {
    return Int{z3::ite(condition.expr(), then.expr(), otherwise.expr())};
  }
};

}  // namespace stormproof::smt
