// Each file grows under a temporary name, so none is ever half-written.
#include "checker/cli/diff_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "checker/cli/counterexample_files.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/experiments/diff/paired_charts.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/simulator.hpp"
#include "model/trace/trace_writer.hpp"

namespace stormproof::cli {

namespace {

namespace fs = std::filesystem;
using Error = std::optional<std::string>;

Error write_trace(const std::string& path, const model::Scenario& scenario) {
  OutputFile file{path};
  if (auto error = file.open_error()) return error;
  model::trace::TraceWriter trace{file.stream(), scenario};
  model::RunOptions options;
  options.probe = &trace;
  trace.finish(model::simulate(scenario, options));
  return file.commit();
}

class DiffFiles {
 public:
  DiffFiles(std::string directory, diff::Files& files)
      : directory_{std::move(directory)}, files_{files} {}

  Error telling_apart(const diff::DiffReport& report) {
    const diff::TellingApart& apart = report.telling_apart;
    model::Scenario candidate = apart.scenario;
    candidate.dds = apart.candidate;
    Error error = side("base", apart.scenario);
    if (!error) error = side("candidate", candidate);
    if (error) return error;
    const std::string chart = path("telling-apart.svg");
    error = write_text(
        chart, diff::paired_charts_svg(apart, report.base.reference, report.candidate.reference));
    if (!error) files_["telling-apart.chart"] = chart;
    return error;
  }

  Error counterexample(const diff::VerdictChange& change) {
    const std::string stem = path(change.property);
    Error error = write_counterexample(*change.counterexample, stem);
    if (!error) files_[change.property] = stem + ".jsonl";
    return error;
  }

 private:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (fs::path{directory_} / name).string();
  }

  Error side(const std::string& name, const model::Scenario& scenario) {
    const std::string trace = path(name + ".jsonl");
    const std::string yaml = path("telling-apart." + name + ".yaml");
    Error error = write_trace(trace, scenario);
    if (!error) error = write_text(yaml, model::config::effective_yaml(scenario));
    if (error) return error;
    files_["telling-apart." + name] = trace;
    files_["telling-apart." + name + ".scenario"] = yaml;
    return std::nullopt;
  }

  std::string directory_;
  diff::Files& files_;
};

}  // namespace

Error write_diff_files(const std::string& directory, const diff::DiffReport& report,
                       diff::Files& files) {
  bool any = report.telling_apart.found;
  for (const diff::VerdictChange& change : report.verdicts.properties) {
    any = any || change.counterexample;
  }
  if (!any) return std::nullopt;
  if (auto error = make_folder("-o", directory)) return error;
  DiffFiles writer{directory, files};
  if (report.telling_apart.found) {
    if (auto error = writer.telling_apart(report)) return error;
  }
  for (const diff::VerdictChange& change : report.verdicts.properties) {
    if (!change.counterexample) continue;
    if (auto error = writer.counterexample(change)) return error;
  }
  return std::nullopt;
}

}  // namespace stormproof::cli
