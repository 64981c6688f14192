// One generic descriptor of one generic relation, in time: the system that is derived from the
// rules of the composition with deadlines (checker/engines/tables/derived_time.hpp), and the same
// assumptions about others as checker/engines/tables/descriptor_system.hpp. The timers of a
// profile, Δ and σ are unknowns; its other knobs have their values. The ghost `limit` counts from
// when both sides are open and the descriptor exists, and grows with each loss: by what puts an
// expiry off, or, for readers that ask by themselves, to the next attempt of an initial ACKNACK.
#pragma once

#include "checker/engines/bounds/completion_bound.hpp"
#include "checker/engines/smt/symbolic.hpp"
#include "checker/engines/tables/descriptor_system.hpp"

namespace stormproof::tables {

namespace watched {
/// Both sides are open, and the descriptor exists, or they have been.
inline constexpr const char* counting = "counting";
/// When a HEARTBEAT was sent last that tells our reader of the descriptor.
inline constexpr const char* heartbeat_sent = "HEARTBEAT sent";
/// DATA that carries the descriptor has been sent to our reader, and another time.
inline constexpr const char* data_sent = "DATA sent";
inline constexpr const char* data_sent_again = "DATA sent again";
/// When the reader's side was opened.
inline constexpr const char* opened = "opened";
/// The kind of the initial ACKNACKs that are looked at.
inline constexpr const char* initial_acknack = "initial AckNack";
}  // namespace watched

class TimedDescriptor {
 public:
  /// Of attempts: `first` after the opening one is scheduled; what was lost has spoilt nothing that
  /// is sent `loss` later; `exchange` after an attempt its answer is there.
  using Bound = timeline::Losses<smt::Symbolic>;

  struct Options {
    bool loses = true;           ///< packets can be lost
    bool exact = false;          ///< every packet takes Δ
    bool counts_copies = false;  ///< whether DATA with the descriptor is sent again
    bool attempts = false;  ///< initial ACKNACKs are looked at, and the limit is that of attempts
    bool stale = false;     ///< the writer holds a reader as up to date that has forgotten it
    std::function<void(Bound&)> tighten{};  ///< changes what the limit is made of, for tests
    Unsound unsound = Unsound::none;        ///< for tests
  };

  TimedDescriptor(const model::DdsProfile& dds, const model::Mutation& mistakes,
                  const Options& options);

  [[nodiscard]] const Expr& operator[](const std::string& name) const {
    return derivation_.variable(name);
  }
  [[nodiscard]] const timeline::Delays<smt::Symbolic>& delays() const { return delays_; }
  [[nodiscard]] const Expr& initial() const { return initial_; }  ///< τ_I
  [[nodiscard]] const Bound& bound() const { return bound_; }
  /// By when the attempt after `time` is due, of those that go on since `opened`.
  [[nodiscard]] Expr next_attempt(const Expr& time, const Expr& opened) const;
  /// τ_H, τ_A, τ_N, τ_S, Δ, σ, τ_I.
  [[nodiscard]] Exprs unknowns() const;
  /// What is assumed of the unknowns: none is negative, τ_H ≥ 1, σ ≤ Δ.
  [[nodiscard]] Exprs assumptions() const;
  /// All steps.
  [[nodiscard]] TransitionSystem whole() const { return derivation_.system(); }

 private:
  void start_stale();

  timeline::Delays<smt::Symbolic> delays_;
  Expr initial_;
  bool doubles_;  ///< the distances of attempts
  Bound bound_;
  Derivation derivation_;
};

/// Whether both sides of the relation are open and the descriptor exists; `at` gives the value of a
/// variable.
[[nodiscard]] Expr can_be_asked_for(const model::DdsProfile& dds,
                                    const std::function<Expr(const char*)>& at);

}  // namespace stormproof::tables
