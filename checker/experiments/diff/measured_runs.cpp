// One job is a pair of runs with the same schedule.
#include "checker/experiments/diff/measured_runs.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>

#include "checker/experiments/trials/parallel.hpp"
#include "model/reference.hpp"
#include "model/simulator.hpp"

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
  set(Measure::completion, result.discovery_time
                               ? static_cast<double>(result.discovery_time->count())
                               : std::numeric_limits<double>::infinity());
  set(Measure::messages, total);
  set(Measure::initial_data, static_cast<double>(counts.initial_data));
  set(Measure::repair_data, static_cast<double>(counts.repair_data));
  set(Measure::heartbeat, static_cast<double>(counts.heartbeat));
  set(Measure::acknack, static_cast<double>(counts.acknack));
  set(Measure::spdp_multicast, static_cast<double>(counts.spdp_multicast));
  set(Measure::spdp_unicast, static_cast<double>(counts.spdp_unicast));
  set(Measure::user_control, static_cast<double>(result.user_control));
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
  bool identical = false;
};

class Runner {
 public:
  Runner(const std::vector<ReviewedPoint>& points, const RunSettings& settings)
      : points_{points}, settings_{settings} {
    for (const ReviewedPoint& point : points) {
      failure_free_.emplace_back(
          static_cast<double>(model::failure_free_reference(point.base).total()),
          static_cast<double>(model::failure_free_reference(point.candidate).total()));
    }
  }

  void want(std::size_t point, std::size_t sample) { jobs_.push_back({point, sample, {}}); }

  bool run() {
    return checker::parallel_for(jobs_.size(), settings_.threads,
                                 [this](std::size_t k) { return run_pair(jobs_[k]); });
  }

  struct Job {
    std::size_t point = 0;
    std::size_t sample = 0;
    std::optional<Pair> pair;
  };
  [[nodiscard]] const std::vector<Job>& jobs() const { return jobs_; }

 private:
  std::optional<RunResult> simulate(const Scenario& scenario) {
    model::RunOptions options;
    options.on_progress = [this](const model::Progress&) { return report(0); };
    RunResult result = model::simulate(scenario, options);
    if (result.end == model::RunEnd::interrupted) return std::nullopt;
    return result;
  }

  bool run_pair(Job& job) {
    Scenario base = points_[job.point].base;
    Scenario candidate = points_[job.point].candidate;
    if (base.deployment.schedule) {
      base.deployment.draw_schedule(settings_.first_seed + job.sample);
      candidate.deployment = base.deployment;
    }
    const auto before = simulate(base);
    const auto after = before ? simulate(candidate) : std::nullopt;
    if (!after) return false;
    Pair pair{values_of(*before, failure_free_[job.point].first),
              values_of(*after, failure_free_[job.point].second), same_results(*before, *after)};
    job.pair = pair;
    return report(1);
  }

  bool report(std::size_t newly_finished) {
    const std::lock_guard lock{mutex_};
    finished_ += newly_finished;
    if (settings_.on_progress && !settings_.on_progress(finished_, jobs_.size())) stopped_ = true;
    return !stopped_;
  }

  const std::vector<ReviewedPoint>& points_;
  const RunSettings& settings_;
  std::vector<std::pair<double, double>> failure_free_;
  std::vector<Job> jobs_;
  bool stopped_ = false;
  std::mutex mutex_;
  std::size_t finished_ = 0;
};

}  // namespace

std::vector<double> PairedRuns::column(const std::vector<RunValues>& runs, Measure measure) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const RunValues& run : runs) values.push_back(run[static_cast<std::size_t>(measure)]);
  return values;
}

bool add_runs(const std::vector<ReviewedPoint>& points, const std::vector<RunsWanted>& wanted,
              const RunSettings& settings, std::vector<PairedRuns>& runs) {
  Runner runner{points, settings};
  for (const auto& [point, samples] : wanted) {
    for (std::size_t k = runs[point].size(); k < samples; ++k) runner.want(point, k);
  }
  const bool finished = runner.run();
  std::vector<bool> whole(points.size(), true);
  for (const Runner::Job& job : runner.jobs()) {
    if (!job.pair) whole[job.point] = false;
  }
  for (const Runner::Job& job : runner.jobs()) {
    if (!whole[job.point]) continue;
    runs[job.point].before.push_back(job.pair->before);
    runs[job.point].after.push_back(job.pair->after);
    runs[job.point].identical = runs[job.point].identical && job.pair->identical;
  }
  return finished;
}

}  // namespace stormproof::diff
