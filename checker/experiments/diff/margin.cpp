// The storm-free margin: the theorem's threshold of the delay, and the highest load of the grid up
// to which nothing storms.
#include <algorithm>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "checker/engines/timeline/free_threshold.hpp"
#include "checker/experiments/diff/costs.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"
#include "props/monitors/delay_meter.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::diff {

namespace {

/// Why the theorem is not about the deployments, as a clause; empty: it is about all of them.
std::string_view why_not(const props::Property& theorem, std::span<const ReviewedPoint> points,
                         model::Scenario ReviewedPoint::*side) {
  for (const ReviewedPoint& point : points) {
    const props::Applicability answer = applicability_of(theorem, point.*side);
    if (!answer.applies()) return answer.why_not;
    if (!answer.why_not_provable.empty()) return answer.why_not_provable;
  }
  return {};
}

void add_threshold(const model::DdsProfile& dds, std::span<const ReviewedPoint> points,
                   model::Scenario ReviewedPoint::*side, Margin& margin) {
  const model::ImplementationTraits& traits = model::traits_of(dds);
  const props::Property& threshold_exists = *props::find_property("storm.free-threshold");
  if (!applicability_of(threshold_exists, model::kind_of(dds)).applies()) {
    margin.formula = fmt::format("no theorem is about {}'s writer", traits.whose);
    return;
  }
  if (const std::string_view why = why_not(threshold_exists, points, side); !why.empty()) {
    margin.formula = fmt::format("the theorem is not about these deployments: {}", why);
    return;
  }
  if (traits.writer == model::Writer::stateful) {
    // The theorem about one descriptor does not carry over: its timers are shared by all readers.
    margin.formula = fmt::format("{}'s shared timers leave no threshold above 0", traits.whose);
    return;
  }
  const bool constant_delay =
      !points.empty() && std::ranges::all_of(points, [side](const ReviewedPoint& point) {
        return props::takes_equal_times((point.*side).wireless);
      });
  const timeline::FreeThreshold threshold = timeline::free_threshold(dds.sedp, constant_delay);
  margin.unlimited = threshold.exists && threshold.unlimited;
  if (threshold.exists && !threshold.unlimited) margin.threshold = threshold.delta;
  margin.formula = threshold.formula;
}

/// The highest load without a storm at it or below.
void add_load(const CostComparison& costs, bool after, Margin& margin) {
  std::map<std::uint64_t, std::vector<const Configuration*>> by_load;
  for (const Configuration& configuration : costs.configurations) {
    by_load[configuration.descriptors].push_back(&configuration);
  }
  for (const auto& [load, configurations] : by_load) {
    const bool storms = std::ranges::any_of(configurations, [after](const Configuration* each) {
      return after ? each->storm_after : each->storm_before;
    });
    if (storms) return;
    margin.load = load;
    margin.load_configuration = configurations.front()->name;
  }
}

/// Whether the runs show that the configuration is more of a storm (`sign` 1) or less (−1) than
/// before, beyond chance.
bool is_shown(const Configuration& configuration, const CostComparison& costs, int sign) {
  for (const Measure measure : {Measure::repair_data, Measure::completion}) {
    const std::optional<Shift>& shift = configuration[measure].shift;
    if (!shift) return true;  // with one of the profiles discovery never completes
    const bool is_known = shift->exact || shift->confidence >= costs.confidence;
    if (is_known && (sign > 0 ? shift->low > 0 : shift->high < 0)) return true;
  }
  return false;
}

/// The loads against each other: 1 the candidate's margin is smaller, −1 greater, 0 neither.
int compare_loads(const CostComparison& costs, MarginComparison& margins) {
  const std::optional<std::uint64_t>& before = margins.before.load;
  const std::optional<std::uint64_t>& after = margins.after.load;
  if (before == after) return 0;
  const int sign = !after || (before && *after < *before) ? 1 : -1;
  const std::uint64_t upper = std::max(before.value_or(0), after.value_or(0));
  const auto load_text = [](const std::optional<std::uint64_t>& load) {
    return load ? report::grouped(*load) + " descriptors" : std::string{"none of the grid"};
  };
  margins.reason =
      fmt::format("highest storm-free load {} → {}", load_text(before), load_text(after));
  const bool shown = std::ranges::any_of(costs.configurations, [&](const Configuration& each) {
    return each.descriptors <= upper && each.storm_before != each.storm_after &&
           each.storm_after == (sign > 0) && is_shown(each, costs, sign);
  });
  if (shown) return sign;
  margins.reason += ", by no more than the chance of the drawn schedules";
  return 0;
}

/// The same for the thresholds.
int compare_thresholds(const Margin& before, const Margin& after, std::string& reason) {
  const auto rank = [](const Margin& margin) {
    constexpr std::int64_t above_all = INT64_MAX;
    if (margin.unlimited) return above_all;
    return margin.threshold ? margin.threshold->count() : 0;
  };
  if (rank(before) == rank(after)) return 0;
  const auto text = [](const Margin& margin) {
    if (margin.unlimited) return std::string{"unlimited"};
    return margin.threshold ? props::time_text(*margin.threshold) : std::string{"none"};
  };
  if (!reason.empty()) reason += "; ";
  reason +=
      fmt::format("longest delay without needless repairs {} → {}", text(before), text(after));
  return rank(after) < rank(before) ? 1 : -1;
}

}  // namespace

MarginComparison compare_margins(const model::DdsProfile& base, const model::DdsProfile& candidate,
                                 std::span<const ReviewedPoint> points, const CostComparison& costs,
                                 const Policy& policy) {
  MarginComparison margins;
  add_threshold(base, points, &ReviewedPoint::base, margins.before);
  add_threshold(candidate, points, &ReviewedPoint::candidate, margins.after);
  add_load(costs, false, margins.before);
  add_load(costs, true, margins.after);
  const int load = compare_loads(costs, margins);
  const bool comparable = model::traits_of(base).writer == model::traits_of(candidate).writer;
  const int threshold =
      comparable ? compare_thresholds(margins.before, margins.after, margins.reason) : 0;
  // What the runs show counts before what the theorem guarantees.
  const int sign = load != 0 ? load : threshold;
  if (sign > 0) margins.judgment = policy.margin ? Judgment::regression : Judgment::worse;
  if (sign < 0) margins.judgment = Judgment::better;
  return margins;
}

}  // namespace stormproof::diff
