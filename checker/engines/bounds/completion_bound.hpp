// B(k, Δ, τ): how long after its opening a relation can lack a descriptor, if no packet takes
// longer than Δ and at most k of its packets are lost (live.completion). Derivation in
// specs/guide/bounds.md; proof in checker/engines/timeline/completion_theorem.cpp.
#pragma once

#include <optional>
#include <string>

#include "checker/engines/bounds/loss_bound.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::timeline {

/// What the bound is asked for, besides the profile.
struct Circumstances {
  model::Nanoseconds delta;  ///< Δ ≥ μ: no packet takes longer from emission to reception
  /// σ: how long a packet needs to leave its source. Unknown: it may be all of Δ.
  std::optional<model::Nanoseconds> source;
  /// The writer's HEARTBEAT timer starts when the relation opens: it is the writer's only one.
  /// Otherwise its next expiry can be at any distance up to τ_H. (`implementation: paper` only)
  bool timer_starts_with_relation = false;
  /// μ: no packet takes less. The bound holds with 0, but only with at least 1 ns it is attained:
  /// without delays the order of same-time decisions would have to help.
  model::Nanoseconds least;
};

/// The bound as a function of k.
struct CompletionBound {
  model::Nanoseconds exchange;      ///< F = 3Δ + τ_A + τ_N: HEARTBEAT, ACKNACK, repair
  model::Nanoseconds window;        ///< HEARTBEATs spoilt by one lost repair: W
  std::int64_t spoilt = 0;          ///< s: how many periods fit into W
  model::Nanoseconds no_loss;       ///< B(0)
  model::Nanoseconds one_loss;      ///< B(1)
  model::Nanoseconds second_loss;   ///< B(2) − B(1)
  model::Nanoseconds further_loss;  ///< B(k) − B(k − 1) for k > 2
  std::string formula;              ///< of B, for reports

  /// B(k); nothing if it exceeds what a time can hold.
  [[nodiscard]] std::optional<model::Nanoseconds> after(unsigned losses) const;
};

/// The looser bound that the rules give for both writers, in ns.
[[nodiscard]] Losses<fsm::Plain> loss_bound(const model::DdsProfile& dds,
                                            const Circumstances& circumstances);

/// Nothing for `heartbeat_policy: adaptive`, whose periods vary, and for delays beyond a year.
[[nodiscard]] std::optional<CompletionBound> completion_bound(const model::DdsProfile& dds,
                                                              const Circumstances& circumstances);

/// B(k) of the paper's writer with nothing known but Δ.
[[nodiscard]] std::optional<model::Nanoseconds> completion_bound(const model::SedpProfile& sedp,
                                                                 unsigned k,
                                                                 model::Nanoseconds delta);

}  // namespace stormproof::timeline
