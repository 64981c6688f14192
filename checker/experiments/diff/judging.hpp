// What counts as a regression of the costs: each configuration by itself, and those together that
// do not settle it by themselves. specs/guide/diff.md states the rules for users.
//
// With C configurations and M measures that are judged some interval would lie on the wrong side by
// chance alone, so all statements share the probability of a mistake, α = 1 − confidence: half of
// it goes to the single configurations, in equal parts (Bonferroni), half to the pooled statements,
// and both are divided by the number of looks at growing samples.
#pragma once

#include <vector>

#include "checker/experiments/diff/measured_runs.hpp"

namespace stormproof::diff {

/// A measure of a pair of runs. Of one that was cut only the least is known: that it is more.
struct KnownChange {
  double before = 0, after = 0;
  bool cut_before = false, cut_after = false;

  [[nodiscard]] bool is_exact() const { return !cut_before && !cut_after; }
  void add_relative_to(statistics::PairedDifferences& changes) const;
};
[[nodiscard]] KnownChange known_change(const PairedRuns& runs, std::size_t k, Measure measure);

class CostJudge {
 public:
  /// `looks`: how often the configurations may be judged, each time with more runs.
  CostJudge(const Policy& policy, const std::vector<ReviewedPoint>& points, std::size_t looks);

  /// Of each single interval.
  [[nodiscard]] double single_confidence() const { return single_confidence_; }

  /// Judges one deployment by its runs, of which there must be at least one pair.
  [[nodiscard]] Configuration judge(const ReviewedPoint& point, const PairedRuns& runs) const;

  /// The configurations that leave a measure open, together: settles them if it can. The runs are
  /// those of the configurations, in their order.
  [[nodiscard]] std::vector<PooledChange> settle(std::vector<Configuration>& configurations,
                                                 const std::vector<const PairedRuns*>& runs) const;

 private:
  [[nodiscard]] MeasuredChange change(Measure measure, const PairedRuns& runs, bool exact) const;
  /// `relative`: the interval of the relative change, from `runs` pairs.
  void judge_change(MeasuredChange& change, const Shift& relative, std::size_t runs) const;
  [[nodiscard]] bool is_unnoticed(const MeasuredChange& change) const;
  [[nodiscard]] std::vector<LimitCrossing> crossings(const ReviewedPoint& point,
                                                     const PairedRuns& runs, bool exact) const;

  Policy policy_;
  double single_confidence_ = 0;
  double pooled_confidence_ = 0;
};

/// Whether something about the configuration is not settled.
[[nodiscard]] bool is_unclear(const Configuration& configuration);
/// The worst of all measures, judged or only shown, and limits.
[[nodiscard]] Judgment worst(const Configuration& configuration);
/// Whether the policy has a tolerance for it; changes of other measures are only shown.
[[nodiscard]] bool is_judged(const Policy& policy, Measure measure);
/// The worst of the judged measures and limits; `better` if some are and none is worse.
[[nodiscard]] Judgment judgment_of(const Configuration& configuration, const Policy& policy);
[[nodiscard]] Judgment together(const std::vector<Judgment>& all);
/// Order of badness: better, same, worse, unclear, regression.
[[nodiscard]] int badness(Judgment judgment);

}  // namespace stormproof::diff
