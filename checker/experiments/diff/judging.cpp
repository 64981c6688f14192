// Single configurations: intervals against tolerances, limits, and whether they storm.
#include "checker/experiments/diff/judging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "checker/experiments/diff/words.hpp"

namespace stormproof::diff {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const Policy::Tolerance* tolerance_of(const Policy& policy, Measure measure) {
  const auto at = std::ranges::find(policy.tolerances, measure, &Policy::Tolerance::measure);
  return at == policy.tolerances.end() ? nullptr : &*at;
}

bool none_finite(const std::vector<double>& values) {
  return std::ranges::none_of(values, [](double value) { return std::isfinite(value); });
}

/// Half of the runs are a storm.
bool storms(const std::vector<exact::Health>& runs) {
  const auto bad = std::ranges::count(runs, exact::Health::storm);
  return !runs.empty() && 2 * static_cast<std::size_t>(bad) >= runs.size();
}

std::size_t limits_of(const Policy& policy, const ReviewedPoint& point) {
  const std::optional<model::Limits>& limits = policy.limits ? policy.limits : point.limits;
  if (!limits) return 0;
  return std::size_t{limits->completion.has_value()} + limits->messages.has_value() +
         limits->amplification.has_value() + limits->backlog.has_value();
}

}  // namespace

void KnownChange::add_relative_to(statistics::PairedDifferences& changes) const {
  if (is_exact()) {
    changes.add_relative(before, after);
    return;
  }
  const double change = statistics::relative_change(before, after);
  changes.add_between(cut_before ? -1 : change, cut_after ? infinity : change);
}

KnownChange known_change(const PairedRuns& runs, std::size_t k, Measure measure) {
  const auto known = [&](const RunValues& run) {
    const double value = run[static_cast<std::size_t>(measure)];
    return std::isinf(value) && runs.is_cut(run) ? static_cast<double>(runs.cut_at->count())
                                                 : value;
  };
  return {known(runs.before[k]), known(runs.after[k]), runs.is_cut(runs.before[k]),
          runs.is_cut(runs.after[k])};
}

CostJudge::CostJudge(const Policy& policy, const std::vector<ReviewedPoint>& points,
                     std::size_t looks)
    : policy_{policy} {
  // Every judged measure, every limit, and whether it storms.
  std::size_t singles = 0;
  for (const ReviewedPoint& point : points) {
    singles += policy.tolerances.size() + limits_of(policy, point) + 1;
  }
  const double half = (1 - policy.confidence) / 2;
  const auto share = [&](std::size_t parts) {
    return half / static_cast<double>(std::max<std::size_t>(parts, 1) * looks);
  };
  single_confidence_ = 1 - share(singles);
  pooled_confidence_ = 1 - share(policy.tolerances.size());
}

MeasuredChange CostJudge::change(Measure measure, const PairedRuns& runs, bool exact) const {
  MeasuredChange change;
  change.measure = measure;
  const std::vector<double> before = PairedRuns::column(runs.before, measure);
  const std::vector<double> after = PairedRuns::column(runs.after, measure);
  change.before = statistics::quantiles(before);
  change.after = statistics::quantiles(after);
  statistics::PairedDifferences differences;
  statistics::PairedDifferences ratios;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const KnownChange known = known_change(runs, k, measure);
    if (known.is_exact()) {
      differences.add(after[k] - before[k]);
    } else {
      differences.add_between(known.cut_before ? -infinity : known.after - known.before,
                              known.cut_after ? infinity : known.after - known.before);
    }
    known.add_relative_to(ratios);
  }
  const auto shift_of = [&](const statistics::PairedDifferences& pairs) {
    return exact ? pairs.fact() : pairs.shift(single_confidence_);
  };
  const Shift relative = shift_of(ratios);
  if (!none_finite(before) && !none_finite(after)) {
    change.shift = shift_of(differences);
    if (change.before.median.value_or(0) > 0) {
      change.relative = relative.estimate;
      change.relative_low = relative.low;
      change.relative_high = relative.high;
    }
  }
  change.cut_at = runs.cut_at;
  if (!runs.identical) judge_change(change, relative, runs.size());
  return change;
}

/// A discovery that is over a moment later is no worse for anybody.
bool CostJudge::is_unnoticed(const MeasuredChange& change) const {
  return change.measure == Measure::completion && change.shift &&
         change.shift->high <= static_cast<double>(policy_.unnoticed.count());
}

void CostJudge::judge_change(MeasuredChange& change, const Shift& relative,
                             std::size_t runs) const {
  if (!change.before.min && !change.after.min && !change.cut_at) {  // only the completion has none
    change.reason = "discovery completes in no run of either profile";
    return;
  }
  const Policy::Tolerance* tolerance = tolerance_of(policy_, change.measure);
  const double allowed =
      tolerance == nullptr || is_unnoticed(change) ? infinity : tolerance->increase;
  const std::string medians =
      fmt::format("median {} → {}", median_text(change, change.before.median),
                  median_text(change, change.after.median));
  if (relative.confidence < single_confidence_) {
    if (tolerance == nullptr) return;
    change.judgment = Judgment::unclear;
    change.reason = fmt::format("{}: {} are too few for a confidence of {}", medians,
                                plural(runs, "run"), share_text(single_confidence_));
  } else if (relative.low > allowed) {
    change.judgment = Judgment::regression;
    change.reason = fmt::format("{}, {}; at most {} is allowed", medians, change_text(change),
                                change_text(allowed));
  } else if (relative.high > allowed) {
    change.judgment = Judgment::unclear;
    change.reason =
        fmt::format("{}, {}; {} do not settle whether that is above the allowed {}", medians,
                    change_text(change), plural(runs, "run"), change_text(allowed));
  } else if (relative.high < 0) {
    change.judgment = Judgment::better;
  } else if (relative.low > 0) {
    change.judgment = Judgment::worse;
  }
}

Configuration CostJudge::judge(const ReviewedPoint& point, const PairedRuns& runs) const {
  const bool exact = !point.is_drawn();
  Configuration configuration;
  configuration.name = point.name;
  configuration.values = point.values;
  configuration.hosts = point.base.deployment.host_count();
  configuration.participants = point.base.deployment.size();
  configuration.descriptors = load_of(point);
  configuration.samples = runs.size();
  configuration.identical_runs = runs.identical;
  for (std::size_t k = 0; k < common_measure_count; ++k) {
    configuration.measures[k] = change(static_cast<Measure>(k), runs, exact);
  }
  configuration.crossings = crossings(point, runs, exact);
  configuration.storm_before = storms(runs.health_before);
  configuration.storm_after = storms(runs.health_after);
  return configuration;
}

bool is_unclear(const Configuration& configuration) {
  return std::ranges::any_of(
             configuration.measures,
             [](const MeasuredChange& change) { return change.judgment == Judgment::unclear; }) ||
         std::ranges::any_of(configuration.crossings, [](const LimitCrossing& crossing) {
           return crossing.judgment == Judgment::unclear;
         });
}

Judgment worst(const Configuration& configuration) {
  std::vector<Judgment> all;
  for (const MeasuredChange& change : configuration.measures) all.push_back(change.judgment);
  for (const LimitCrossing& crossing : configuration.crossings) all.push_back(crossing.judgment);
  return together(all);
}

bool is_judged(const Policy& policy, Measure measure) {
  return tolerance_of(policy, measure) != nullptr;
}

Judgment judgment_of(const Configuration& configuration, const Policy& policy) {
  std::vector<Judgment> all;
  for (const MeasuredChange& change : configuration.measures) {
    if (is_judged(policy, change.measure)) all.push_back(change.judgment);
  }
  for (const LimitCrossing& crossing : configuration.crossings) all.push_back(crossing.judgment);
  return together(all);
}

Judgment together(const std::vector<Judgment>& all) {
  // Better in one place and worse in none is better; better beside worse is not.
  Judgment found = Judgment::same;
  bool any_better = false;
  for (const Judgment judgment : all) {
    any_better = any_better || judgment == Judgment::better;
    if (badness(judgment) > badness(found)) found = judgment;
  }
  return any_better && found == Judgment::same ? Judgment::better : found;
}

int badness(Judgment judgment) {
  switch (judgment) {
    case Judgment::better:
      return 0;
    case Judgment::same:
      return 1;
    case Judgment::worse:
      return 2;
    case Judgment::unclear:
      return 3;
    case Judgment::regression:
      return 4;
  }
  return 4;
}

}  // namespace stormproof::diff
