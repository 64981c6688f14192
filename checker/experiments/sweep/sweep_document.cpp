// Counts what came of the jobs, and says it.
#include <map>

#include <fmt/core.h>

#include "checker/experiments/sweep/sweep_report.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/json/describe.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::sweep {

namespace {

using report::grouped;

struct Totals {
  std::size_t completed = 0;
  std::size_t incomplete = 0;
  std::size_t failed = 0;
  std::string first_error;
};

Totals count(const Plan& plan, const Collector& results) {
  Totals totals;
  for (std::size_t job = 0; job < plan.size(); ++job) {
    const Outcome* outcome = results.outcome(job);
    if (outcome == nullptr) continue;
    if (outcome->failed() && totals.first_error.empty()) totals.first_error = outcome->error;
    ++(outcome->failed()      ? totals.failed
       : outcome->completed() ? totals.completed
                              : totals.incomplete);
  }
  return totals;
}

/// The settings that the model has not got, of all profiles in the plan.
std::map<std::string, std::string> unmodelled_in(const Plan& plan) {
  std::map<std::string, std::string> all;
  for (std::size_t job = 0; job < plan.size(); ++job) {
    if (plan.first_alike(job) != job || plan.error(job)) continue;
    const model::DdsProfile dds = plan.scenario(job).dds;
    all.insert(dds.unmodelled.begin(), dds.unmodelled.end());
  }
  return all;
}

}  // namespace

report::Document document_of(const Plan& plan, const Collector& results,
                             const std::string& database) {
  const Status& status = results.status();
  const Totals totals = count(plan, results);
  const std::size_t open = status.jobs - totals.completed - totals.incomplete - totals.failed;
  report::Document document;
  document.title = "stormproof sweep " + plan.grid().source;
  document.complete = open == 0;
  document.exit_code = totals.completed == plan.size() ? 0 : 3;
  document.tone = document.exit_code == 0 ? report::Tone::good : report::Tone::warn;
  document.subject = fmt::format("{}: {} of {} already done in {}, {} run now", plan.grid().source,
                                 grouped(status.already_done), grouped(status.jobs), database,
                                 grouped(status.finished));
  std::string answer =
      fmt::format("{} of {} complete discovery", grouped(totals.completed), grouped(status.jobs));
  if (totals.incomplete > 0) {
    answer += fmt::format(", {} incomplete when they ended", grouped(totals.incomplete));
  }
  if (totals.failed > 0) answer += fmt::format(", {} cannot run", grouped(totals.failed));
  if (open > 0) answer += fmt::format(", {} left: the sweep was interrupted", grouped(open));
  document.answer = answer;
  if (totals.failed > 0) {
    document.elaboration = "first that cannot run: " + totals.first_error;
  }
  model::DdsProfile dds;
  dds.unmodelled = unmodelled_in(plan);
  add_unmodelled(document, dds);
  return document;
}

nlohmann::ordered_json to_json(const Plan& plan, const Collector& results,
                               const std::string& database) {
  const Status& status = results.status();
  const Totals totals = count(plan, results);
  report::JsonObject v;
  v("grid", plan.grid().source);
  v("database", database);
  v("jobs", status.jobs);
  v("already_done", status.already_done);
  v("finished", status.finished);
  v("completed", totals.completed);
  v("incomplete", totals.incomplete);
  v("failed", totals.failed);
  v.or_null("first_error", totals.first_error);
  v.unless_empty("unmodelled", unmodelled_in(plan));
  return std::move(v).take();
}

}  // namespace stormproof::sweep
