// The same runs and the same judgment as for the whole change.
#include "checker/experiments/diff/blame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::diff {

namespace config = model::config;

namespace {

using Json = nlohmann::ordered_json;

/// With more knobs than this, pairs are tried only with the knob that alone helps most.
constexpr std::size_t all_pairs_up_to = 6;

Json::json_pointer pointer_of(std::string key) {
  std::ranges::replace(key, '.', '/');
  return Json::json_pointer{"/" + key};
}

/// How much the configuration regresses: the surest relative increase of a measure.
double severity(const Configuration& configuration) {
  double worst = -1;
  for (const MeasuredChange& change : configuration.measures) {
    if (change.judgment != Judgment::regression) continue;
    worst = std::max(worst, change.relative_low.value_or(std::numeric_limits<double>::infinity()));
  }
  for (const LimitCrossing& crossing : configuration.crossings) {
    if (crossing.judgment == Judgment::regression) worst = std::max(worst, 0.0);
  }
  return worst;
}

class BlameStudy {
 public:
  BlameStudy(const CostRequest& request, const ReviewedPoint& point, const PairedRuns& runs)
      : request_{request}, point_{point}, samples_{runs.size()}, cut_at_{runs.cut_at} {}

  /// Nothing if the keys cannot be set back; `interrupted` if it was stopped.
  std::optional<Blame::Entry> revert(const std::vector<std::string>& keys) {
    const auto dds = with_reverted(point_.candidate.dds, point_.base.dds, keys);
    if (!dds) return std::nullopt;
    std::vector<ReviewedPoint> points{point_};
    points.front().candidate.dds = *dds;
    model::choose_multicast(points.front().candidate);
    std::vector<PairedRuns> runs(1);
    runs.front().cut_at = cut_at_;
    interrupted = !add_runs(points, {{0, samples_}}, request_.first_seed, request_.runner, runs);
    if (interrupted) return std::nullopt;
    CostJudge judge{request_.policy, points, 1};
    std::vector<Configuration> judged{judge.judge(points.front(), runs.front())};
    (void)judge.settle(judged, {&runs.front()});
    const auto median = [&](Measure measure) {
      return judged.front()[measure].after.median.value_or(
          std::numeric_limits<double>::quiet_NaN());
    };
    return Blame::Entry{
        keys, median(Measure::completion), median(Measure::messages),
        badness(judgment_of(judged.front(), request_.policy)) < badness(Judgment::unclear)};
  }

  bool interrupted = false;

 private:
  const CostRequest& request_;
  const ReviewedPoint& point_;
  std::size_t samples_;
  std::optional<model::Nanoseconds> cut_at_;
};

/// The pairs to try after the singles.
std::vector<std::vector<std::string>> pairs_of(const std::vector<Blame::Entry>& singles) {
  const auto slower = [](const Blame::Entry& a, const Blame::Entry& b) {
    const auto rank = [](double median) { return std::isnan(median) ? HUGE_VAL : median; };
    return rank(a.completion_median) < rank(b.completion_median);
  };
  const auto best = std::min_element(singles.begin(), singles.end(), slower);
  std::vector<std::vector<std::string>> pairs;
  if (singles.size() <= 2) return pairs;  // the pair of all is the base itself
  for (auto first = singles.begin(); first != singles.end(); ++first) {
    for (auto second = first + 1; second != singles.end(); ++second) {
      if (singles.size() > all_pairs_up_to && first != best && second != best) continue;
      pairs.push_back({first->reverted.front(), second->reverted.front()});
    }
  }
  return pairs;
}

}  // namespace

std::optional<model::DdsProfile> with_reverted(const model::DdsProfile& candidate,
                                               const model::DdsProfile& base,
                                               const std::vector<std::string>& keys) {
  if (candidate.implementation != base.implementation) return std::nullopt;
  Json changed = config::effective_json(candidate);
  const Json original = config::effective_json(base);
  for (const std::string& key : keys) {
    const Json::json_pointer at = pointer_of(key);
    if (original.contains(at)) {
      changed[at] = original[at];
    } else if (changed.contains(at)) {  // as if nothing is said of it
      changed[at.parent_pointer()].erase(at.back());
    } else {
      return std::nullopt;
    }
  }
  const auto tree = config::parse_yaml(changed.dump(), "profile");
  if (!tree) return std::nullopt;
  model::DdsProfile profile;
  std::optional<config::InputError> failure;
  config::read_knobs(*tree, "", profile, failure);
  if (failure) return std::nullopt;
  return profile;
}

std::optional<Blame> blame(const std::vector<KnobChange>& changes, const CostRequest& request,
                           const CostAnswer& costs) {
  std::vector<std::string> keys;
  for (const KnobChange& change : changes) {
    if (change.matters) keys.push_back(change.key);
  }
  const auto& configurations = costs.comparison.configurations;
  const auto worst_one = std::max_element(
      configurations.begin(), configurations.end(),
      [](const Configuration& a, const Configuration& b) { return severity(a) < severity(b); });
  if (keys.size() < 2 || worst_one == configurations.end() || severity(*worst_one) < 0) {
    return std::nullopt;
  }
  const auto point = std::ranges::find(request.grid.points, worst_one->name, &ReviewedPoint::name);
  const auto place = static_cast<std::size_t>(point - request.grid.points.begin());
  BlameStudy study{request, *point, costs.runs[place]};
  Blame found;
  found.configuration = worst_one->name;
  const auto add = [&](const std::vector<std::string>& reverted) {
    if (auto entry = study.revert(reverted)) found.entries.push_back(*std::move(entry));
    return !study.interrupted;
  };
  for (const std::string& key : keys) {
    if (!add({key})) return std::nullopt;
  }
  if (std::ranges::none_of(found.entries, &Blame::Entry::cures) && !found.entries.empty()) {
    for (const std::vector<std::string>& pair : pairs_of(found.entries)) {
      if (!add(pair)) return std::nullopt;
    }
  }
  if (found.entries.empty()) return std::nullopt;
  return found;
}

}  // namespace stormproof::diff
