// The runs are real counterexamples, so that there is something to draw.
#include "tests/checker/presentation/document/examples.hpp"

#include "tests/checker/verification/counterexample/examples.hpp"

namespace stormproof::report {

namespace {

using props::Finding;
using props::VerdictKind;

Finding finding(VerdictKind kind, std::string how) {
  Finding result;
  result.kind = kind;
  result.engine = "exact run";
  result.how = std::move(how);
  result.assumptions = {"assuming " + hostile};
  return result;
}

checker::PropertyResult result_of(std::string_view id, Finding decisive) {
  checker::PropertyResult result;
  result.property = props::find_property(id);
  result.verdict = decisive.kind;
  result.findings.push_back(std::move(decisive));
  return result;
}

Finding violation(const props::Counterexample& counterexample) {
  Finding result = finding(VerdictKind::violated, "the run of this scenario");
  result.counterexample = counterexample;
  return result;
}

model::config::Place place(const std::string& file, int line, int column) {
  return {std::make_shared<const std::string>(file), line, column};
}

statistics::Quantiles around(double median) {
  return statistics::quantiles({median * 0.8, median, median * 1.3});
}

diff::Configuration configuration(const std::string& endpoints, std::uint64_t descriptors,
                                  double factor) {
  diff::Configuration one;
  one.name = "participants_per_host 5, endpoints_per_participant " + endpoints;
  one.values = {{"deployment.participants_per_host", "5"},
                {"deployment.endpoints_per_participant", endpoints}};
  one.hosts = 2;
  one.participants = 10;
  one.descriptors = descriptors;
  one.samples = 12;
  for (std::size_t k = 0; k < diff::common_measure_count; ++k) {
    diff::MeasuredChange& change = one.measures[k];
    change.measure = static_cast<diff::Measure>(k);
    const double before = k == 0 ? 2e9 : 1000.0 + 100.0 * static_cast<double>(k);
    change.before = around(before);
    change.after = around(before * factor);
    change.shift =
        diff::Shift{before * (factor - 1), before * (factor - 1.2), before * factor, 0.95, false};
    change.relative = factor - 1;
    change.relative_low = factor - 1.2;
    change.relative_high = factor;
  }
  return one;
}

diff::Blame blame(const std::string& name) {
  diff::Blame result;
  result.configuration = name;
  result.entries.push_back({{"sedp.heartbeat_period"}, 2e9, 1100, true});
  return result;
}

}  // namespace

CheckExample::CheckExample()
    : scenario_{counterexample::scenario_named("smallest")},
      context_{"robots " + hostile + ".yaml", scenario_, {}, {}} {
  report_.results.push_back(
      result_of("fsm.determinism", finding(VerdictKind::proved, "for all states")));
  report_.results.push_back(
      result_of("timer.single-heartbeat", violation(counterexample::additive())));
  report_.results.push_back(
      result_of("live.completion", finding(VerdictKind::inconclusive, "time-out")));
  report_.results.push_back(
      result_of("storm.free-threshold", violation(counterexample::smallest())));
  scenario_.dds.unmodelled.emplace("setting " + hostile, "an effect " + hostile);
  context_.counterexamples.emplace("storm.free-threshold", "ce/storm.free-threshold.jsonl");
  context_.stories.emplace("storm.free-threshold",
                           [hostile = hostile](std::size_t) { return "a story\nof " + hostile; });
  context_.gate = checker::judge(report_, scenario_.dds, {.strict = true});
  const std::string file = "my robots.yaml";
  context_.places.emplace("deployment", place(file, 1, 1));
  context_.places.emplace("dds.sedp.heartbeat_timer", place(file, 7, 22));
  context_.places.emplace("dds.sedp.heartbeat_period", place(file, 8, 23));
  context_.places.emplace("dds.unmodelled.setting " + hostile, place(file, 9, 5));
}

diff::DiffReport regression() {
  diff::DiffReport report;
  report.base.reference = "fastdds-2.6.11";
  report.candidate.reference = "new " + hostile + ".xml";
  report.candidate.value.unmodelled.emplace("transport", "shared memory " + hostile);
  report.policy.name = "default";
  report.policy.tolerances = {{diff::Measure::completion, 0.25}};
  report.profiles.changes = {{"sedp.acknack_bytes",
                              "64",
                              "65",
                              {},
                              place("new.xml", 3, 9),
                              true,
                              false,
                              "nobody reads it"},
                             {"sedp.heartbeat_period", "1s", hostile, place("base.yaml", 5, 1),
                              place("new.xml", 12, 34), true, true, ""}};
  report.verdicts.done = true;
  report.verdicts.scenario = "smallest";
  report.verdicts.properties = {
      {"fsm.determinism",
       "It is.",
       VerdictKind::proved,
       VerdictKind::proved,
       "how",
       "how",
       diff::Judgment::same,
       {}},
      {"storm.free-threshold", "No repair.", VerdictKind::proved, VerdictKind::violated, "theorem",
       "a run", diff::Judgment::regression, counterexample::smallest()}};
  report.costs.grid = "review";
  report.costs.samples = 12;
  report.costs.confidence = 0.99;
  report.costs.wanted = 2;
  report.costs.configurations = {configuration("10", 370, 1.0), configuration("20", 1850, 2.5)};
  diff::Configuration& worst = report.costs.configurations.back();
  worst.measures[0].judgment = diff::Judgment::regression;
  worst.measures[0].reason = "at most +25 % is allowed";
  worst.crossings = {{"limit.completion", "completion 3s", 0, 0.75, diff::Judgment::regression}};
  worst.storm_after = true;
  report.margin.before.threshold = model::Nanoseconds{49'940'000};
  report.margin.before.load = 1850;
  report.margin.before.load_configuration = worst.name;
  report.margin.judgment = diff::Judgment::unclear;
  report.margin.reason = "it may be smaller";
  report.telling_apart.found = true;
  report.telling_apart.scenario = counterexample::scenario_named("smallest");
  report.telling_apart.how = "searched from two participants upward";
  report.telling_apart.difference = "one sends what the other does not: " + hostile;
  report.telling_apart.base_run = counterexample::lossy();
  report.telling_apart.candidate_run = counterexample::smallest();
  report.blame = blame(worst.name);
  report.judgment = diff::Judgment::regression;
  report.reasons = {"completion at " + worst.name + ": worse " + hostile};
  return report;
}

diff::DiffReport equality() {
  diff::DiffReport report;
  report.base.reference = "paper";
  report.candidate.reference = "paper";
  report.policy.name = "default";
  report.profiles.relation = diff::Relation::identical;
  report.profiles.proof = "Every knob has the same value.";
  report.telling_apart.how = "Equal profiles have equal runs.";
  return report;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) {
    ++count;
  }
  return count;
}

}  // namespace stormproof::report
