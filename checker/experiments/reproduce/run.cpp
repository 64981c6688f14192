// The runs of a plan, spread over the cores one by one, because the runs of one case may differ in
// length by a factor of a hundred.
#include "checker/experiments/reproduce/run.hpp"

#include <algorithm>
#include <ctime>

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

/// The class of the model, which has them in the same order.
std::optional<model::MessageClass> class_of(Class one) {
  const auto index = static_cast<std::size_t>(one);
  if (index >= model::message_class_count) return std::nullopt;
  return model::message_classes[index];
}

template <class Value>
std::optional<double> mean_of(const std::vector<Run>& runs, Value value) {
  double sum = 0;
  for (const Run& one : runs) {
    if (!one.completion) return std::nullopt;
    sum += value(one);
  }
  if (runs.empty()) return std::nullopt;
  return sum / static_cast<double>(runs.size());
}

double seconds(model::Nanoseconds time) { return static_cast<double>(time.count()) * 1e-9; }

}  // namespace

const char* name_of(Class one) {
  if (const auto of_model = class_of(one)) return model::name_of(*of_model);
  return one == Class::spdp ? "spdp" : "total";
}

std::uint64_t count_of(const model::Counts& counts, Class one) {
  if (const auto of_model = class_of(one)) return counts[*of_model];
  return one == Class::spdp ? counts.spdp() : counts.total();
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
    if (!one.completion) return std::nullopt;
    worst = std::max(worst.value_or(0), seconds(*one.completion));
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
  std::vector<double> cpu_s(jobs.size());
  trials::Runner runner{limits.threads, limits.on_progress};
  const auto finished = runner.run(jobs.size(), [&](std::size_t j) -> std::optional<Run> {
    const double before = thread_cpu_s();
    const auto result = runner.simulate(plan.scenario(*jobs[j].which, jobs[j].k));
    cpu_s[j] = thread_cpu_s() - before;
    if (!result) return std::nullopt;
    return Run{result->end, result->discovery_time, result->counts};
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
