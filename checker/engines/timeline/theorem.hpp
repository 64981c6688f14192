// A theorem over linear-integer timelines: its parameters, its conditions, each decided by Z3 and
// cvc5, and the verdict that they add up to. A condition without an answer makes the verdict
// inconclusive, and one to which the solvers give opposite answers makes it disputed.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/smt/decision.hpp"
#include "checker/engines/smt/symbolic.hpp"
#include "checker/engines/timeline/exchange.hpp"

namespace stormproof::timeline {

using Int = smt::SymbolicInt;
using Bool = smt::SymbolicBool;
using Sym = smt::Symbolic;

/// Truth value → truth value.
[[nodiscard]] inline Bool implies(const Bool& a, const Bool& b) { return !a || b; }

class Theorem {
 public:
  Theorem(std::string_view property, const checker::CheckRequest& request);

  [[nodiscard]] z3::context& context() { return context_; }
  /// Not with a mutant: a theorem is about the correct rules, and stays true. Whether the machines
  /// still follow them is for the boundary runs to say.
  [[nodiscard]] bool is_asked_for() const { return request_.mutant == nullptr; }
  /// A fresh unknown.
  [[nodiscard]] Int number(const std::string& name) { return Int::named(name); }
  /// A fresh unknown in [low, high].
  [[nodiscard]] Int within(const std::string& name, const Int& low, const Int& high);
  /// A fresh unknown from `low` on.
  [[nodiscard]] Int at_least(const std::string& name, const Int& low);
  [[nodiscard]] Bool choice(const std::string& name) { return Bool::named(name); }
  /// What holds from here on.
  void assume(const Bool& fact);

  /// Under what has been assumed, `claim` is always true. Remembers if not.
  bool holds(std::string_view condition, const Bool& claim);
  /// Under what has been assumed, `claim` can be true. Remembers if not.
  bool possible(std::string_view condition, const Bool& claim);
  /// Assumptions made from here on are dropped by `close`.
  [[nodiscard]] std::size_t open() const { return assumptions_.size(); }
  void close(std::size_t mark);

  /// The conjunction of what has been assumed.
  [[nodiscard]] z3::expr assumptions();
  [[nodiscard]] bool proved() const { return gap_.empty(); }
  /// Something makes a proof worthless.
  void give_up(std::string why);

  /// How many conditions were decided, by whom, and what is missing. To be called once, at the end.
  [[nodiscard]] props::Finding finish(std::string how);

 private:
  [[nodiscard]] smt::Answer ask(std::string_view condition, const Bool& claim);

  const checker::CheckRequest& request_;
  std::string property_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  z3::context context_;
  smt::SymbolicContext current_{context_};
  std::vector<Bool> assumptions_;
  std::size_t asked_ = 0;
  std::string gap_;
};

/// The parameters that all theorems share: τ_A, τ_N, τ_S ≥ 0, τ_H > 0, 0 ≤ μ ≤ Δ, 0 ≤ σ ≤ Δ.
struct Parameters {
  explicit Parameters(Theorem& theorem);

  Int least;   ///< μ: no packet takes less
  Int delta;   ///< Δ: no packet takes longer
  Int source;  ///< σ: no packet needs longer to leave its source
  Timers<Sym> timers;
  Int period;  ///< τ_H

  /// A passage within Δ and σ.
  [[nodiscard]] Passage<Sym> passage(Theorem& theorem, const std::string& name) const;
};

}  // namespace stormproof::timeline
