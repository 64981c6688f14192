// What all certificates over a timed descriptor have in common: what is assumed, the words in which
// something is stated of it, and candidates of what else holds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "checker/engines/tables/certificate.hpp"
#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/timed_descriptor.hpp"

namespace stormproof::tables {

/// By how many nanoseconds the parts of the bound (TimedDescriptor::Bound) are claimed to be
/// smaller than they are: none, except to show that they cannot be.
struct Tighter {
  int first = 0;
  int loss = 0;
  int exchange = 0;

  bool operator==(const Tighter&) const = default;
};
[[nodiscard]] std::function<void(TimedDescriptor::Bound&)> tightened_by(const Tighter& tighter);

/// States what the timed system takes as given.
void assume_in_time(Proof& proof);

/// An invariant over the steps of a descriptor in time, while it comes into being, and what
/// follows.
class TimedStatement {
 public:
  explicit TimedStatement(const TimedDescriptor& system) : system_{system} {}

  std::vector<Clause> stated;
  std::vector<Clause> conclusions;
  std::vector<StepClause> on_steps;

 protected:
  void say(std::string words, const Expr& holds) { stated.push_back({std::move(words), holds}); }
  /// What is pending is due within its delay.
  void within(const std::string& timer, const Expr& pending, const Expr& delay);
  /// What is looked at as one of this kind arrives within Δ.
  void arrives_in_time(const std::string& kind);
  /// A repair that is looked at leaves its source within σ.
  void repairs_leave_in_time();

  [[nodiscard]] Expr is(const std::string& name) const { return system_[name]; }
  [[nodiscard]] Expr now() const { return is(timed::now); }
  [[nodiscard]] Expr due(const std::string& timer) const { return is(timed::due(timer)); }
  [[nodiscard]] Expr pending(const std::string& timer) const { return is("pending " + timer); }
  /// One of the kind is looked at, and arrives by then.
  [[nodiscard]] Expr arrives_by(const std::string& kind, const Expr& latest) const;
  static Expr by(const Expr& time, const Expr& latest) { return time <= latest; }
  static Expr if_then(const Expr& condition, const Expr& consequence) {
    return z3::implies(condition, consequence);
  }
  static Expr number(int value) { return smt::SymbolicContext::current().int_val(value); }
  static Expr true_() { return smt::SymbolicContext::current().bool_val(true); }

  const TimedDescriptor& system_;
};

/// The certificate of a statement.
[[nodiscard]] Certificate certificate_of(const TimedDescriptor& descriptor,
                                         const TimedStatement& statement);

/// A certificate of nothing yet: the system that moves, what is given of the unknowns, and
/// candidates.
[[nodiscard]] Certificate certificate_in_time(const TimedDescriptor& descriptor,
                                              const Moving& moving);
/// Adds an assumption about the unknowns.
void give(Certificate& certificate, std::string words, const Expr& holds);

}  // namespace stormproof::tables
