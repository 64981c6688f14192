// The transition system of one generic descriptor of one generic relation of one writer, as it
// comes into being: its variables, and the step that a rule is being turned into. Everything but
// the one descriptor enters as unknowns, by three rules that follow from who owns what:
//   1. a packet that was ever sent with some content may arrive any number of times, at any time;
//   2. a timer that was ever started may be due at any time; a counted one while its count is
//      positive;
//   3. quantifiers are "ours, or an unknown"; each rule also happens for another descriptor, reader
//      or stream, of which nothing is known; loops run for others, ours and others again.
// None of them knows a protocol. checker/engines/tables/derived_world.hpp is the world that does
// the deriving.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checker/engines/tables/transition_system.hpp"

namespace stormproof::tables {

/// Which of the owner's indices are not ours: fsm::composition::Owner::indices.
using Foreign = std::uint8_t;

/// What the number of our descriptor is called.
inline constexpr const char* its_number = "its number";

/// A mistake in the derivation, for the test that notices it.
enum class Unsound : std::uint8_t {
  none,
  others_never_ask,    ///< a quantifier is about our descriptor only
  rules_for_us_only,   ///< no rule happens for another reader, stream or descriptor
  loops_for_us_only,   ///< a loop over readers runs for ours only
  packets_arrive_once  ///< what has arrived cannot arrive again
};

class Derivation {
 public:
  explicit Derivation(Unsound mistake) : mistake_{mistake} {}

  // Variables.
  void declare(const std::string& name, bool start);
  void declare_count(const std::string& name);
  /// Descriptors have numbers, and what is counted are the first ones: ours is among them if its
  /// number, an unknown that no step changes, is at most how many these are.
  void number_descriptors();
  [[nodiscard]] const std::optional<Expr>& number() const { return number_; }
  /// The system starts with another value of the variable.
  void start_with(const std::string& name, bool value);
  [[nodiscard]] bool has(const std::string& name) const { return index_.contains(name); }
  /// The variable itself, for properties.
  [[nodiscard]] const Expr& variable(const std::string& name) const {
    return variables_.at(index_.at(name));
  }

  // The step that is being derived.
  void begin();
  /// Ends the step; it is kept if it changes anything.
  void end(const std::string& name);
  /// The present value of a variable.
  [[nodiscard]] Expr& now(const std::string& name) { return now_.at(index_.at(name)); }
  /// The variable becomes `value` if `when`.
  void assign(const std::string& name, const Expr& when, const Expr& value);
  /// The step is possible only if `condition`.
  void require(const Expr& condition) { guard_ = guard_ && condition; }
  /// An input that traces show, and one that they do not.
  Expr input(const std::string& name);
  Expr unknown();
  Expr unknown_count();
  /// How many the first descriptors are, of which ours is one or not.
  Expr count_of_first(const Expr& ours_is_one);

  [[nodiscard]] bool is(Unsound mistake) const { return mistake_ == mistake; }

  /// All steps; `bad` is left to the property.
  [[nodiscard]] TransitionSystem system() const;

 private:
  Unsound mistake_;
  Exprs variables_;
  Exprs start_;
  std::map<std::string, std::size_t> index_;
  std::vector<SystemStep> steps_;
  std::optional<Expr> number_;

  Exprs now_;
  Exprs inputs_;
  Expr guard_{smt::SymbolicContext::current().bool_val(true)};
};

/// The variables that never change: the largest set of which every possible step keeps the initial
/// values if it finds them, as far as simplifying tells. For systems of a derivation.
[[nodiscard]] std::vector<bool> never_changing(const TransitionSystem& system);
/// The same system with the initial values in place of those variables.
[[nodiscard]] TransitionSystem without(const std::vector<bool>& never_changing,
                                       const TransitionSystem& system);
/// A system of a derivation without what never changes, and expressions about it.
class Moving {
 public:
  explicit Moving(const TransitionSystem& whole);

  TransitionSystem system;
  /// An expression over the variables of the whole system as one over those that change.
  [[nodiscard]] Expr operator()(const Expr& expr) const;

 private:
  Moving(const TransitionSystem& whole, const std::vector<bool>& never);

  Exprs from_;
  Exprs to_;
};
/// The same system with values in place of constants that are no variables.
[[nodiscard]] TransitionSystem with(const TransitionSystem& system, const Exprs& constants,
                                    const Exprs& values);
/// Of the variables that never change, those for which `of` is true, and those on which it depends
/// that these do not change.
[[nodiscard]] std::vector<bool> reasons(const TransitionSystem& system,
                                        const std::vector<bool>& never_changing,
                                        std::vector<bool> of);

/// The same question with what cannot matter to `system.bad` left out: variables that never change,
/// then those that neither `bad` nor the steps of what remains can see. The answer is the same. For
/// systems of a derivation.
[[nodiscard]] TransitionSystem what_matters(const TransitionSystem& system);

}  // namespace stormproof::tables
