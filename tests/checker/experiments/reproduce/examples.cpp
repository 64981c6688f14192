// Made-up results, and the shipped figures.
#include "tests/checker/experiments/reproduce/examples.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace stormproof::reproduce {

std::string shipped(const std::string& name) {
  for (const std::string& directory : model::config::SpecPath::standard().directories) {
    std::ifstream file{directory + "/published/" + name};
    if (!file) continue;
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  ADD_FAILURE() << name << " was not found";
  return {};
}

Published shipped_figures() {
  const auto published = read_published(model::config::SpecPath::standard());
  EXPECT_TRUE(published) << (published ? "" : to_string(published.error()));
  return published ? *published : Published{};
}

Published figures_with_grid(const std::string& participants, const std::string& endpoints) {
  std::string tables = shipped("paper-tables.yaml");
  const std::size_t grid = tables.find("\ngrid:") + 1;
  tables.replace(grid, tables.find('\n', grid) - grid,
                 "grid: {hosts: 2, participants_per_host: " + participants +
                     ", endpoints_per_participant: " + endpoints + ", runs: 15}");
  const auto published = parse_published(tables, shipped("paper-notes.yaml"), "test");
  EXPECT_TRUE(published) << (published ? "" : to_string(published.error()));
  return published ? *published : Published{};
}

Plan plan_of(const Published& published, const PlanOptions& options) {
  const auto plan = make_plan(published, options, model::config::SpecPath::standard());
  EXPECT_TRUE(plan) << (plan ? "" : to_string(plan.error()));
  return plan ? *plan : Plan{};
}

Run finished_run(double seconds, const model::Counts& counts) {
  Run run;
  run.end = model::RunEnd::completed;
  run.completion = model::Nanoseconds{std::llround(seconds * 1e9)};
  run.counts = counts;
  return run;
}

Results made_up(const Plan& plan) {
  Results results;
  results.plan = plan;
  results.complete = true;
  for (const Case& one : plan.cases) {
    const auto np = std::uint64_t{one.configuration.participants_per_host};
    const double size = static_cast<double>(np) * one.configuration.endpoints_per_participant;
    const bool wireless = one.network == Network::wireless;
    double seconds = wireless ? size * 1e-3 : 1e-3;
    if (one.policy == model::HeartbeatPolicy::adaptive) seconds /= 2;
    if (one.order == orders[1]) seconds *= 0.99;
    if (one.order == orders[2]) seconds *= 0.97;
    model::Counts counts;
    counts.initial_data = np;
    counts.repair_data = np;
    counts.heartbeat = np;
    counts.acknack = np;
    counts.spdp_multicast = wireless ? 5 * np : np;
    counts.spdp_unicast = wireless ? np : 0;
    Outcome outcome;
    outcome.runs.assign(plan.variants[one.variant].runs, finished_run(seconds, counts));
    results.outcomes.emplace(one, std::move(outcome));
  }
  return results;
}

Report report_of(const Published& published, Results results) {
  Report report;
  report.version = "test";
  report.published = published;
  report.results = std::move(results);
  report.figures = compare(report.published, report.results);
  return report;
}

}  // namespace stormproof::reproduce
