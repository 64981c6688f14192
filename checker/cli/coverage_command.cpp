// `stormproof coverage OBSERVATIONS`: reads the measurements, has them compared, and draws the
// result.
#include <filesystem>
#include <fstream>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/evidence/coverage/report.hpp"

namespace stormproof::cli {

namespace {

using prediction::Observations;

struct CoverageArguments {
  std::string observations;
  prediction::ReadOptions read;
  std::vector<std::string> baseline_select;
  prediction::StudyRequest request;
  std::string output;  ///< folder; empty: none
};

model::config::Result<Observations> read(const std::string& path,
                                         const prediction::ReadOptions& options) {
  using model::config::InputError;
  if (std::filesystem::is_directory(path)) {
    return InputError{path, "is a directory; expected a file"};
  }
  if (!std::filesystem::exists(path)) {
    return InputError{path, "no such file; expected measured runs, one JSON object per line"};
  }
  std::ifstream file{path};
  if (!file) return InputError{path, "cannot be read"};
  return prediction::read_observations(file, path, options);
}

/// Charts, and the page that the frame writes; what could not be written, or nothing.
std::string write_charts(const std::string& folder, const prediction::Study& study,
                         Answer& answer) {
  namespace fs = std::filesystem;
  answer.files.emplace_back((fs::path{folder} / "coverage.html").string(), report::Format::html);
  for (const prediction::ProfileStudy& profile : study.profiles) {
    for (const prediction::ChartFile& chart : prediction::charts(profile)) {
      OutputFile file{(fs::path{folder} / chart.name).string()};
      if (const auto error = file.open_error()) return *error;
      file.stream() << chart.svg;
      if (const auto error = file.commit()) return *error;
    }
  }
  return {};
}

Outcome run(CoverageArguments& arguments, Session& session) {
  prediction::StudyRequest& request = arguments.request;
  if (request.baseline.empty() && !(arguments.baseline_select.empty() && request.change.empty())) {
    return Complaint{"--baseline-select and --change need --baseline PROFILE"};
  }
  const auto measured = read(arguments.observations, arguments.read);
  if (!measured) return measured.error();
  model::config::Result<Observations> baseline{Observations{}};
  if (!arguments.baseline_select.empty()) {
    baseline = read(arguments.observations, {arguments.read.completion, arguments.baseline_select});
    if (!baseline) return baseline.error();
  }
  if (!arguments.output.empty()) {
    if (const auto error = make_folder("--output", arguments.output)) return Complaint{*error};
  }
  request.predict.on_progress = session.on_runs();
  const auto study = prediction::study(measured->rows, baseline->rows, request);
  if (!study) return study.error();
  const prediction::Heading heading{arguments.observations,  measured->rows.size(),
                                    measured->not_selected,  request.wireless,
                                    request.predict.samples, request.predict.first_seed};
  Answer answer{document_of(heading, *study), to_json(heading, *study)};
  answer.document.exit_code = study->interrupted ? inconclusive : established;
  if (!arguments.output.empty()) {
    answer.complaint = write_charts(arguments.output, *study, answer);
  }
  return answer;
}

void declare_model(Options& options, prediction::StudyRequest& request) {
  options.texts("--dds", request.dds, "DDS profile to predict with (repeatable)", "PROFILE")
      .required();
  options.text("--wireless", request.wireless, "Wireless profile", "PROFILE").required();
  options.overrides(request.overrides, "all scenarios");
  options.texts("--runs", request.words,
                "What processes run by a word of a row's profiles: a name or a map of keys "
                "(repeatable)",
                "WORD=PROFILE");
  options
      .number("--samples", request.predict.samples,
              "Schedules drawn for each configuration (default 12)", "N")
      .within(1, 100'000);
  options.seed(request.predict.first_seed, "Seed of the first schedule (default 0)");
  options.jobs(request.predict.threads);
  options.choice(
      "--channel", request.channel,
      {{"profile", prediction::ChannelSource::profile}, {"row", prediction::ChannelSource::row}},
      "profile (default): skip runs of other channels; row: each run's own channel", "SOURCE");
}

void declare_rows(Options& options, CoverageArguments& arguments) {
  options
      .text("observations", arguments.observations, "Measured runs, one JSON object per line",
            "OBSERVATIONS")
      .required();
  options.texts("--select", arguments.read.select,
                "Only rows with this value of a field (repeatable)", "FIELD=VALUE");
  options.texts("--scope", arguments.request.scopes,
                "Only this scope: np1, np2, …, all, high_load (repeatable)", "SCOPE");
  options.choice(
      "--completion", arguments.read.completion,
      {{"app", prediction::CompletionTime::app}, {"strict", prediction::CompletionTime::strict}},
      "Which completion time of a row: app (default, T_app_ms) or strict (T_strict_ms)", "KIND");
}

void declare(Options& options, CoverageArguments& arguments) {
  declare_rows(options, arguments);
  declare_model(options, arguments.request);
  options.text("--baseline", arguments.request.baseline,
               "Ratios to this DDS profile, with 90 % intervals", "PROFILE");
  options.texts("--baseline-select", arguments.baseline_select,
                "Rows that were measured with the baseline, if those of --select were not",
                "FIELD=VALUE");
  options.texts("--change", arguments.request.change,
                "As --set, but not for the baseline (repeatable)", "KEY=VALUE");
  options.folder("-o,--output", arguments.output,
                 "Folder for charts (SVG) and one page of all (coverage.html)");
}

}  // namespace

void declare_coverage(Frame& frame) {
  frame.add<CoverageArguments>(
      {"coverage",
       "How well predictions fit measured runs: coverage, ratios, calibration",
       "Exit code: 0 everything was predicted, 3 interrupted, 2 bad input.",
       Formats::pages,
       {prediction::json_schema}},
      declare, run);
}

}  // namespace stormproof::cli
