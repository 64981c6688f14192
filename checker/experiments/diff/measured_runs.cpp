// One job is a pair of runs with the same schedule.
#include "checker/experiments/diff/measured_runs.hpp"

#include <algorithm>

#include "checker/experiments/statistics/completion.hpp"
#include "checker/experiments/trials/under_seed.hpp"
#include "model/reference.hpp"

namespace stormproof::diff {

namespace {

using model::RunResult;
using model::Scenario;

RunValues values_of(const RunResult& result, double failure_free) {
  double backlog = 0;
  for (const model::BacklogPeak& peak : result.backlog) {
    backlog = std::max(backlog, static_cast<double>(peak.packets));
  }
  const model::Counts& counts = result.counts;
  const auto total = static_cast<double>(counts.total());
  RunValues values{};
  const auto set = [&values](Measure measure, double value) {
    values[static_cast<std::size_t>(measure)] = value;
  };
  set(Measure::completion, statistics::completion_ns(result.discovery_time));
  set(Measure::messages, total);
  set(Measure::initial_data, static_cast<double>(counts.initial_data));
  set(Measure::repair_data, static_cast<double>(counts.repair_data));
  set(Measure::heartbeat, static_cast<double>(counts.heartbeat));
  set(Measure::acknack, static_cast<double>(counts.acknack));
  set(Measure::spdp_multicast, static_cast<double>(counts.spdp_multicast));
  set(Measure::spdp_unicast, static_cast<double>(counts.spdp_unicast));
  set(Measure::user_control, static_cast<double>(result.user_control));
  set(Measure::lookup, static_cast<double>(counts.lookup));
  set(Measure::amplification, failure_free > 0 ? total / failure_free : 0);
  set(Measure::backlog, backlog);
  return values;
}

bool same_channels(const RunResult& a, const RunResult& b) {
  return std::ranges::equal(a.channels, b.channels,
                            [](const model::ChannelUse& one, const model::ChannelUse& other) {
                              return one.busy == other.busy;
                            });
}

bool same_backlogs(const RunResult& a, const RunResult& b) {
  return std::ranges::equal(a.backlog, b.backlog,
                            [](const model::BacklogPeak& one, const model::BacklogPeak& other) {
                              return one.packets == other.packets && one.at == other.at &&
                                     one.packets_at_end == other.packets_at_end;
                            });
}

bool same_latencies(const RunResult& a, const RunResult& b) {
  return std::ranges::equal(
      a.latency, b.latency, [](const model::Latency& one, const model::Latency& other) {
        return one.packets == other.packets && one.backlog_sum == other.backlog_sum &&
               one.service_sum == other.service_sum && one.longest == other.longest;
      });
}

/// Whether all numbers of two runs are the same: two runs that are not the same event by event
/// agree in the nanosecond of their end, in the number of events and in the sums of all delays only
/// by a miracle.
bool same_results(const RunResult& a, const RunResult& b) {
  return a.end == b.end && a.end_time == b.end_time && a.discovery_time == b.discovery_time &&
         a.counts == b.counts && a.user_control == b.user_control && a.events == b.events &&
         a.missing_count == b.missing_count && a.useful_deliveries == b.useful_deliveries &&
         a.duplicate_deliveries == b.duplicate_deliveries && same_channels(a, b) &&
         same_backlogs(a, b) && same_latencies(a, b);
}

struct Pair {
  RunValues before{}, after{};
  exact::Health health_before{}, health_after{};
  bool identical = false;
};

/// Messages of the failure-free references of both sides of a deployment.
using References = std::pair<double, double>;

References references_of(const ReviewedPoint& point) {
  return {static_cast<double>(model::failure_free_reference(point.base).total()),
          static_cast<double>(model::failure_free_reference(point.candidate).total())};
}

/// One pair of runs of one deployment.
struct Job {
  std::size_t point = 0;
  std::size_t sample = 0;
};

}  // namespace

std::vector<double> PairedRuns::column(const std::vector<RunValues>& runs, Measure measure) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const RunValues& run : runs) values.push_back(run[static_cast<std::size_t>(measure)]);
  return values;
}

bool add_runs(const std::vector<ReviewedPoint>& points, const std::vector<RunsWanted>& wanted,
              std::uint64_t first_seed, trials::Runner& runner, std::vector<PairedRuns>& runs) {
  std::vector<References> references;
  for (const ReviewedPoint& point : points) references.push_back(references_of(point));
  std::vector<Job> jobs;
  for (const auto& [point, samples] : wanted) {
    for (std::size_t k = runs[point].size(); k < samples; ++k) jobs.push_back({point, k});
  }
  const auto pairs = runner.run(jobs.size(), [&](std::size_t k) -> std::optional<Pair> {
    const auto& [point, sample] = jobs[k];
    Scenario base = trials::under_seed(points[point].base, first_seed + sample);
    Scenario candidate = points[point].candidate;
    if (base.deployment.schedule) candidate.deployment.draw_schedule(first_seed + sample);
    if (const auto& cut = runs[point].cut_at) base.time_limit = candidate.time_limit = *cut;
    const auto before = runner.simulate(base);
    const auto after = before ? runner.simulate(candidate) : std::nullopt;
    if (!after) return std::nullopt;
    return Pair{values_of(*before, references[point].first),
                values_of(*after, references[point].second), exact::health_of(base, *before).health,
                exact::health_of(candidate, *after).health,
                same_results(*before, *after) && (!runs[point].cut_at || before->completed())};
  });
  std::vector<bool> whole(points.size(), true);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!pairs[k]) whole[jobs[k].point] = false;
  }
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!whole[jobs[k].point]) continue;
    PairedRuns& of_point = runs[jobs[k].point];
    of_point.before.push_back(pairs[k]->before);
    of_point.after.push_back(pairs[k]->after);
    of_point.health_before.push_back(pairs[k]->health_before);
    of_point.health_after.push_back(pairs[k]->health_after);
    of_point.identical = of_point.identical && pairs[k]->identical;
  }
  return !runner.stopped();
}

}  // namespace stormproof::diff
