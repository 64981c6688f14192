// Statements about several runs at once that need no interval of a shift: limits, and undecided
// configurations together.
#include <algorithm>

#include <fmt/format.h>

#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/experiments/statistics/confidence.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::diff {

namespace {

/// A limit as a number of its measure, and in words.
struct LimitValue {
  const char* id;
  Measure measure;
  double value;
  std::string text;
};

std::vector<LimitValue> values_of(const model::Limits& limits) {
  std::vector<LimitValue> values;
  if (limits.completion) {
    values.push_back({"limit.completion", Measure::completion,
                      static_cast<double>(limits.completion->count()),
                      "completion " + model::config::print_duration(*limits.completion)});
  }
  if (limits.messages) {
    values.push_back({"limit.messages", Measure::messages, static_cast<double>(*limits.messages),
                      fmt::format("messages {}", *limits.messages)});
  }
  if (limits.amplification) {
    values.push_back({"limit.amplification", Measure::amplification, limits.amplification->value(),
                      fmt::format("amplification {:.6g}", limits.amplification->value())});
  }
  if (limits.backlog) {
    values.push_back({"limit.backlog", Measure::backlog, static_cast<double>(*limits.backlog),
                      fmt::format("backlog {} packets", *limits.backlog)});
  }
  return values;
}

std::size_t exceeding(const std::vector<RunValues>& runs, const LimitValue& limit) {
  const std::vector<double> values = PairedRuns::column(runs, limit.measure);
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [&](double value) { return value > limit.value; }));
}

/// What is decided together holds for each of the undecided configurations.
void spread(const PooledChange& pooled, std::vector<Configuration>& configurations) {
  const std::string whose =
      pooled.configurations == 1
          ? "this configuration"
          : fmt::format("all {} undecided configurations", pooled.configurations);
  for (Configuration& configuration : configurations) {
    MeasuredChange& change = configuration.measures[static_cast<std::size_t>(pooled.measure)];
    if (change.judgment != Judgment::unclear) continue;
    const bool allowed_increase =
        pooled.judgment == Judgment::same && change.relative_low.value_or(0) > 0;
    change.judgment = allowed_increase ? Judgment::worse : pooled.judgment;
    change.reason += fmt::format("; pair by pair the median change of {} is {} ({} … {})", whose,
                                 change_text(pooled.estimate), change_text(pooled.low),
                                 change_text(pooled.high));
  }
}

}  // namespace

std::vector<LimitCrossing> CostJudge::crossings(const ReviewedPoint& point, const PairedRuns& runs,
                                                bool exact) const {
  const std::optional<model::Limits>& limits = policy_.limits ? policy_.limits : point.limits;
  std::vector<LimitCrossing> found;
  if (!limits) return found;
  for (const LimitValue& limit : values_of(*limits)) {
    const std::size_t after = exceeding(runs.after, limit);
    const auto count = static_cast<double>(runs.size());
    LimitCrossing crossing{limit.id, limit.text,
                           static_cast<double>(exceeding(runs.before, limit)) / count,
                           static_cast<double>(after) / count, Judgment::better};
    const bool kept_before = crossing.before <= policy_.limit_share;
    const bool kept_after = crossing.after <= policy_.limit_share;
    if (kept_before == kept_after) continue;
    if (kept_before) {
      const double least = statistics::clopper_pearson(after, runs.size(), single_confidence_).low;
      const bool sure = exact || runs.identical || least > policy_.limit_share;
      crossing.judgment = sure ? Judgment::regression : Judgment::unclear;
    }
    found.push_back(crossing);
  }
  return found;
}

std::vector<PooledChange> CostJudge::settle(std::vector<Configuration>& configurations,
                                            const std::vector<const PairedRuns*>& runs) const {
  std::vector<PooledChange> answers;
  for (const Policy::Tolerance& tolerance : policy_.tolerances) {
    const auto place = static_cast<std::size_t>(tolerance.measure);
    statistics::PairedDifferences changes;
    PooledChange pooled;
    pooled.measure = tolerance.measure;
    for (std::size_t k = 0; k < configurations.size(); ++k) {
      if (configurations[k].measures[place].judgment != Judgment::unclear) continue;
      ++pooled.configurations;
      for (std::size_t run = 0; run < runs[k]->size(); ++run) {
        known_change(*runs[k], run, tolerance.measure).add_relative_to(changes);
      }
    }
    if (pooled.configurations == 0) continue;
    pooled.pairs = changes.size();
    const Shift shift = changes.shift(pooled_confidence_);
    pooled.estimate = shift.estimate;
    pooled.low = shift.low;
    pooled.high = shift.high;
    pooled.confidence = shift.confidence;
    pooled.judgment = Judgment::unclear;
    if (pooled.confidence >= pooled_confidence_) {
      if (pooled.low > tolerance.increase) pooled.judgment = Judgment::regression;
      if (pooled.high <= tolerance.increase) pooled.judgment = Judgment::same;
    }
    if (pooled.judgment != Judgment::unclear) spread(pooled, configurations);
    answers.push_back(pooled);
  }
  return answers;
}

}  // namespace stormproof::diff
