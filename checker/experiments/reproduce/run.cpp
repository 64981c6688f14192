// The runs of a plan, spread over the cores one by one, because the runs of one case may differ in
// length by a factor of a hundred.
#include "checker/experiments/reproduce/run.hpp"

#include <algorithm>
#include <ctime>
#include <iterator>
#include <utility>

#include "checker/experiments/reproduce/decided.hpp"

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

/// The runs of a plan, look by look.
class Evaluation {
 public:
  Evaluation(const Plan& plan, const RunLimits& limits)
      : limits_{limits}, runner_{limits.threads, limits.on_progress} {
    results_.plan = plan;
    for (const Variant& variant : plan.variants) most_ = std::max(most_, variant.runs);
  }

  Results run() {
    results_.complete = true;
    const std::vector<std::size_t> all = limits_.published ? looks(most_) : std::vector{most_};
    for (const std::size_t draws : all) {
      decided_.clear();
      if (!make(jobs_up_to(draws))) break;
    }
    return std::move(results_);
  }

 private:
  std::vector<Job> jobs_up_to(std::size_t draws) {
    std::vector<Job> jobs;
    for (const Case& one : results_.plan.cases) {
      const Outcome* outcome = results_.find(one);
      const std::size_t made = outcome == nullptr ? 0 : outcome->runs.size();
      if (made > 0 && is_enough(one)) continue;
      const std::size_t most = results_.plan.variants[one.variant].runs;
      const std::size_t wanted = is_sampled(one) ? std::min(draws, most) : most;
      for (std::size_t k = made; k < wanted; ++k) jobs.push_back({&one, k});
    }
    return jobs;
  }

  /// Whether it may have fewer draws. Runs without contention cost little, and one configuration
  /// has figures of its own.
  [[nodiscard]] static bool is_sampled(const Case& one) {
    return one.network == Network::wireless && one.configuration != counted;
  }

  bool is_enough(const Case& one) {
    if (limits_.published == nullptr || !is_sampled(one)) return false;
    const std::pair group{one.variant, one.configuration.participants_per_host};
    const auto [entry, fresh] = decided_.try_emplace(group);
    if (fresh && results_.plan.variants[one.variant].runs > 1) {
      entry->second = means_are_decided(*limits_.published, results_, group.first, group.second,
                                        confidence_of_look(most_));
    }
    return entry->second;
  }

  /// The jobs of one case stand together. False: it was interrupted.
  bool make(const std::vector<Job>& jobs) {
    std::vector<double> cpu_s(jobs.size());
    const auto finished = runner_.run(jobs.size(), [&](std::size_t j) -> std::optional<Run> {
      const double before = thread_cpu_s();
      const auto result = runner_.simulate(results_.plan.scenario(*jobs[j].which, jobs[j].k));
      cpu_s[j] = thread_cpu_s() - before;
      if (!result) return std::nullopt;
      return Run{result->end, result->discovery_time, result->counts};
    });
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      const Case& which = *jobs[j].which;
      results_.total_cpu_s += cpu_s[j];
      if (is_evaluation(results_.plan, which)) results_.evaluation_cpu_s += cpu_s[j];
      if (finished[j]) ++results_.runs;
    }
    for (std::size_t j = 0; j < jobs.size();) {
      const Case& which = *jobs[j].which;
      std::vector<Run> runs;
      bool all = true;
      for (; j < jobs.size() && jobs[j].which == &which; ++j) {
        if (finished[j]) runs.push_back(*finished[j]);
        all = all && finished[j].has_value();
      }
      results_.complete = results_.complete && all;
      if (all) std::ranges::move(runs, std::back_inserter(results_.outcomes[which].runs));
    }
    return results_.complete;
  }

  const RunLimits& limits_;
  trials::Runner runner_;
  Results results_;
  std::size_t most_ = 1;
  /// By variant and N_P, at this look.
  std::map<std::pair<std::size_t, std::uint32_t>, bool> decided_;
};

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

Results run(const Plan& plan, const RunLimits& limits) { return Evaluation{plan, limits}.run(); }

}  // namespace stormproof::reproduce
