// Group commits: cheap for a thousand jobs in a moment, prompt for one job in a minute.
#include "checker/experiments/sweep/collector.hpp"

#include <algorithm>

namespace stormproof::sweep {

Collector::Collector(const Plan& plan, Database& database,
                     std::function<bool(const Status&)> on_progress)
    : plan_{plan},
      database_{database},
      on_progress_{std::move(on_progress)},
      outcomes_(plan.size()),
      alike_(plan.size()) {
  status_.jobs = plan.size();
  for (std::size_t job = 0; job < plan.size(); ++job) ++alike_[plan.first_alike(job)];
  for (std::size_t job = 0; job < plan.size(); ++job) {
    if (plan.first_alike(job) != job) continue;
    // A run that failed (out of memory) may succeed today; a combination that is wrong stays so.
    std::optional<Outcome> known = database.find(plan.digest(job));
    if (known && (!known->failed() || plan.error(job))) {
      status_.already_done += alike_[job];
      outcomes_[job] = std::move(known);
    } else {
      open_.push_back(job);
    }
  }
  std::erase_if(open_, [&](std::size_t job) {
    if (!plan.error(job)) return false;
    enter(job, failure(to_string(*plan.error(job))));
    return true;
  });
  commit();
}

void Collector::enter(std::size_t job, Outcome outcome) {
  if (pending_ == 0) pending_since_ = Clock::now();
  if (!database_.add(plan_.digest(job), plan_.values_json(job), outcome)) {
    error_ = database_.error();
    stopped_ = true;
    return;
  }
  ++pending_;
  pending_jobs_ += alike_[job];
  cpu_seconds_ += outcome.cpu_seconds;
  outcomes_[job] = std::move(outcome);
  if (pending_ >= group || Clock::now() - pending_since_ >= patience_) commit();
}

void Collector::commit() {
  if (pending_ == 0) return;
  const Clock::time_point started = Clock::now();
  if (!database_.commit()) {
    error_ = database_.error();
    stopped_ = true;
    return;
  }
  patience_ = std::clamp<Clock::duration>(100 * (Clock::now() - started), shortest_patience,
                                          longest_patience);
  status_.finished += pending_jobs_;
  pending_ = pending_jobs_ = 0;
  report();
}

void Collector::report() {
  if (on_progress_ && !on_progress_(status_)) stopped_ = true;
}

bool Collector::add(std::size_t job, Outcome outcome) {
  const std::lock_guard lock{mutex_};
  if (!error_) enter(job, std::move(outcome));
  return !stopped_;
}

bool Collector::tick() {
  // Whoever holds the lock does what is to be done.
  if (const std::unique_lock lock{mutex_, std::try_to_lock}; lock && !error_) {
    if (stopped_ || Clock::now() - pending_since_ >= patience_) commit();
    report();
  }
  return !stopped_;
}

void Collector::finish() {
  const std::lock_guard lock{mutex_};
  if (error_) return;
  commit();
  if (!error_ && !database_.finish()) error_ = database_.error();
}

const Outcome* Collector::outcome(std::size_t job) const {
  const auto& outcome = outcomes_[plan_.first_alike(job)];
  return outcome ? &*outcome : nullptr;
}

}  // namespace stormproof::sweep
