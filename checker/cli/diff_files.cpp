// The chart first: a folder with a limit may have no room for the traces.
#include "checker/cli/diff_files.hpp"

#include "checker/cli/counterexample_files.hpp"
#include "checker/experiments/diff/paired_charts.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/simulator.hpp"
#include "model/trace/trace_writer.hpp"

namespace stormproof::cli {

namespace {

class DiffFiles {
 public:
  DiffFiles(OutputFolder& folder, diff::Files& files) : folder_{folder}, files_{files} {}

  void telling_apart(const diff::DiffReport& report) {
    const diff::TellingApart& apart = report.telling_apart;
    model::Scenario candidate = apart.scenario;
    candidate.dds = apart.candidate;
    note("telling-apart.chart",
         folder_.write("telling-apart.svg", diff::paired_charts_svg(apart, report.base.reference,
                                                                    report.candidate.reference)));
    side("base", apart.scenario);
    side("candidate", candidate);
  }

  void counterexample(const diff::VerdictChange& change) {
    note(change.property, write_counterexample(folder_, *change.counterexample, change.property));
  }

 private:
  void note(const std::string& what, const std::optional<std::string>& path) {
    if (path) files_[what] = *path;
  }

  void side(const std::string& name, const model::Scenario& scenario) {
    note("telling-apart." + name + ".scenario",
         folder_.write("telling-apart." + name + ".yaml", model::config::effective_yaml(scenario)));
    note("telling-apart." + name, folder_.write(name + ".jsonl", [&](std::ostream& out) {
      model::trace::TraceWriter trace{out, scenario};
      model::RunOptions options;
      options.probe = &trace;
      trace.finish(model::simulate(scenario, options));
      return std::optional<std::string>{};
    }));
  }

  OutputFolder& folder_;
  diff::Files& files_;
};

}  // namespace

void write_diff_files(OutputFolder& folder, const diff::DiffReport& report, diff::Files& files) {
  DiffFiles writer{folder, files};
  if (report.telling_apart.found) writer.telling_apart(report);
  for (const diff::VerdictChange& change : report.verdicts.properties) {
    if (change.counterexample) writer.counterexample(change);
  }
}

}  // namespace stormproof::cli
