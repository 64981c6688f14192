// Counts what came of the jobs, and says it.
#include <map>

#include <fmt/core.h>

#include "checker/experiments/statistics/completion.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/sweep/sweep_report.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/json/schema.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

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

/// Median, and the job that takes longest or is not complete.
struct Spread {
  statistics::Quantiles completion_ns;
  std::optional<std::size_t> worst;  ///< job
};

Spread spread_of(const Plan& plan, const Collector& results) {
  Spread spread;
  std::vector<double> times;
  double most = -1;
  for (std::size_t job = 0; job < plan.size(); ++job) {
    const Outcome* outcome = results.outcome(job);
    if (outcome == nullptr || outcome->failed()) continue;
    std::optional<model::Nanoseconds> time;
    if (outcome->completed()) time = model::Nanoseconds{*outcome->numbers.front()};
    times.push_back(statistics::completion_ns(time));
    if (times.back() <= most) continue;
    most = times.back();
    spread.worst = job;
  }
  spread.completion_ns = statistics::quantiles(std::move(times));
  return spread;
}

/// "deployment.participants_per_host 5, endpoints_per_participant 20".
std::string job_text(const Plan& plan, std::size_t job) {
  std::string text;
  const std::vector<std::string> keys = plan.keys();
  const std::vector<std::string> values = plan.values(job);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", keys[k], values[k]);
  }
  return text.empty() ? "the only one" : text;
}

void add_spread(report::Document& document, const Plan& plan, const Collector& results) {
  const Spread spread = spread_of(plan, results);
  if (!spread.worst) return;
  const auto time = [](const std::optional<double>& ns) {
    return ns ? report::duration(model::Nanoseconds{static_cast<std::int64_t>(*ns)})
              : std::string{"not complete"};
  };
  report::Facts facts;
  facts.rows.emplace_back("median completion", time(spread.completion_ns.median));
  facts.rows.emplace_back("shortest", time(spread.completion_ns.min));
  facts.rows.emplace_back("longest",
                          time(spread.completion_ns.max) + ": " + job_text(plan, *spread.worst));
  document.blocks.emplace_back(std::move(facts));
}

/// "3/16" of one shard, otherwise nothing.
std::string shard_text(const Plan& plan) {
  const grids::Shard shard = plan.shard();
  return shard.count == 1 ? std::string{} : fmt::format("{}/{}", shard.number, shard.count);
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
  const std::string shard = shard_text(plan);
  document.subject =
      fmt::format("{}{}: {} of {} already done in {}, {} run now", plan.grid().source,
                  shard.empty() ? "" : ", shard " + shard, grouped(status.already_done),
                  grouped(status.jobs), database, grouped(status.finished));
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
  add_spread(document, plan, results);
  document.next.push_back({"sqlite3 " + report::shell_word(database) +
                               " 'SELECT * FROM runs ORDER BY t_disc_ns DESC LIMIT 5'",
                           "the runs that take longest; --csv FILE writes all of them as a table"});
  model::DdsProfile dds;
  dds.unmodelled = plan.unmodelled();
  add_unmodelled(document, dds);
  return document;
}

namespace {

struct SweepAnswer {
  std::string grid, shard, database;
  Status status;
  Totals totals;
  std::map<std::string, std::string> unmodelled;
};

template <class V>
void describe(V& v, const SweepAnswer& answer) {
  v("grid", answer.grid);
  v.unless_empty("shard", answer.shard);
  v("database", answer.database);
  v("jobs", answer.status.jobs);
  v("already_done", answer.status.already_done);
  v("run_now", answer.status.finished);
  v("completed", answer.totals.completed);
  v("incomplete", answer.totals.incomplete);
  v("failed", answer.totals.failed);
  v.or_null("first_error", answer.totals.first_error);
  v.unless_empty("unmodelled", answer.unmodelled);
}

}  // namespace

nlohmann::ordered_json to_json(const Plan& plan, const Collector& results,
                               const std::string& database) {
  return report::json_of(SweepAnswer{plan.grid().source, shard_text(plan), database,
                                     results.status(), count(plan, results), plan.unmodelled()});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<SweepAnswer>(definitions);
}

}  // namespace stormproof::sweep
