// The runs of a plan, spread over the cores one by one, because the runs of one case may differ in
// length by a factor of a hundred.
#include "checker/experiments/reproduce/run.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <mutex>

#include "checker/experiments/trials/parallel.hpp"
#include "model/simulator.hpp"

namespace stormproof::reproduce {

namespace {

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

struct Job {
  const Case* which = nullptr;
  std::size_t k = 0;
};

std::vector<Job> jobs_of(const Plan& plan) {
  std::vector<Job> jobs;
  for (const Case& one : plan.cases) {
    for (std::size_t k = 0; k < plan.variants[one.variant].runs; ++k) jobs.push_back({&one, k});
  }
  return jobs;
}

/// Whether this run belongs to the evaluation whose speed is promised.
bool is_evaluation(const Plan& plan, const Case& one) {
  return plan.variants[one.variant].id == "paper" && one.network == Network::wireless &&
         one.policy == model::HeartbeatPolicy::periodic && one.order == orders[0];
}

/// What all threads share.
class Monitor {
 public:
  explicit Monitor(const RunLimits& limits) : limits_{limits} {}

  /// Asks whether to go on; also in the middle of a run.
  bool go_on() {
    if (stopped_) return false;
    if (!limits_.on_progress) return true;
    const std::lock_guard lock{mutex_};
    if (!limits_.on_progress(finished_)) stopped_ = true;
    return !stopped_;
  }
  bool finished() {
    ++finished_;
    return go_on();
  }

 private:
  const RunLimits& limits_;
  std::mutex mutex_;
  std::atomic<std::size_t> finished_ = 0;
  std::atomic<bool> stopped_ = false;
};

template <class Value>
std::optional<double> mean_of(const std::vector<Run>& runs, Value value) {
  double sum = 0;
  std::size_t count = 0;
  for (const Run& one : runs) {
    if (!one.completion) continue;
    sum += value(one);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

double seconds(model::Nanoseconds time) { return static_cast<double>(time.count()) * 1e-9; }

}  // namespace

const char* name_of(Class one) {
  switch (one) {
    case Class::spdp:
      return "spdp";
    case Class::initial_data:
      return "initial_data";
    case Class::repair_data:
      return "repair_data";
    case Class::heartbeat:
      return "heartbeat";
    case Class::acknack:
      return "acknack";
    case Class::total:
      return "total";
    case Class::spdp_multicast:
      return "spdp_multicast";
    case Class::spdp_unicast:
      return "spdp_unicast";
  }
  std::abort();
}

std::uint64_t count_of(const model::Counts& counts, Class one) {
  switch (one) {
    case Class::spdp:
      return counts.spdp_multicast + counts.spdp_unicast;
    case Class::initial_data:
      return counts.initial_data;
    case Class::repair_data:
      return counts.repair_data;
    case Class::heartbeat:
      return counts.heartbeat;
    case Class::acknack:
      return counts.acknack;
    case Class::total:
      return counts.total();
    case Class::spdp_multicast:
      return counts.spdp_multicast;
    case Class::spdp_unicast:
      return counts.spdp_unicast;
  }
  std::abort();
}

std::size_t Outcome::completed() const {
  return static_cast<std::size_t>(std::count_if(
      runs.begin(), runs.end(), [](const Run& one) { return one.completion.has_value(); }));
}

std::optional<double> Outcome::completion_s() const {
  return mean_of(runs, [](const Run& one) { return seconds(*one.completion); });
}

std::optional<double> Outcome::fastest_s() const {
  std::optional<double> best;
  for (const Run& one : runs) {
    if (one.completion) best = std::min(best.value_or(1e300), seconds(*one.completion));
  }
  return best;
}

std::optional<double> Outcome::slowest_s() const {
  std::optional<double> worst;
  for (const Run& one : runs) {
    if (one.completion) worst = std::max(worst.value_or(0), seconds(*one.completion));
  }
  return worst;
}

std::optional<double> Outcome::messages(Class one) const {
  return mean_of(runs,
                 [one](const Run& run) { return static_cast<double>(count_of(run.counts, one)); });
}

const Outcome* Results::find(const Case& one) const {
  const auto found = outcomes.find(one);
  return found == outcomes.end() ? nullptr : &found->second;
}

const Outcome* Results::find(std::size_t variant, Network network,
                             const Configuration& configuration) const {
  return find({variant, network, model::HeartbeatPolicy::periodic, orders[0], configuration});
}

Results run(const Plan& plan, const RunLimits& limits) {
  Results results;
  results.plan = plan;
  const std::vector<Job> jobs = jobs_of(results.plan);
  std::vector<std::optional<Run>> finished(jobs.size());
  std::vector<double> cpu_s(jobs.size());
  Monitor monitor{limits};
  (void)checker::parallel_for(jobs.size(), limits.threads, [&](std::size_t j) {
    const double before = thread_cpu_s();
    const model::Scenario scenario = plan.scenario(*jobs[j].which, jobs[j].k);
    model::RunOptions options;
    options.on_progress = [&](const model::Progress&) { return monitor.go_on(); };
    const model::RunResult result = simulate(scenario, options);
    cpu_s[j] = thread_cpu_s() - before;
    if (result.end == model::RunEnd::interrupted) return false;
    finished[j] = Run{result.end, result.discovery_time, result.counts};
    return monitor.finished();
  });
  results.complete = true;
  for (std::size_t j = 0; j < jobs.size();) {
    const Case& which = *jobs[j].which;
    Outcome outcome;
    bool all = true;
    for (; j < jobs.size() && jobs[j].which == &which; ++j) {
      results.total_cpu_s += cpu_s[j];
      if (is_evaluation(results.plan, which)) results.evaluation_cpu_s += cpu_s[j];
      if (finished[j]) outcome.runs.push_back(*finished[j]);
      all = all && finished[j].has_value();
    }
    results.complete = results.complete && all;
    if (all) results.outcomes.emplace(which, std::move(outcome));
  }
  return results;
}

}  // namespace stormproof::reproduce
