// Reads the scenario, runs it with the observers that were asked for and those of its limits, and
// prints the report.
#include "checker/cli/simulate_command.hpp"

#include <algorithm>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/cli/sample_command.hpp"
#include "checker/evidence/capture/write/capture_probe.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"
#include "model/trace/perfetto.hpp"
#include "model/trace/probe_list.hpp"
#include "model/trace/replay.hpp"
#include "model/trace/trace_writer.hpp"
#include "props/limits.hpp"

namespace stormproof::cli {

namespace {

/// The files that were asked for, as observers of the run.
class Recorders {
 public:
  Recorders(const SimulateArguments& arguments, const model::Scenario& scenario)
      : trace_file_{arguments.trace_file},
        perfetto_file_{arguments.perfetto_file},
        pcap_file_{arguments.pcap_file},
        limits_{scenario} {
    for (model::Probe* probe : limits_.probes()) probes_.add(*probe);
    if (trace_file_.wanted()) {
      trace_.emplace(trace_file_.stream(), scenario);
      probes_.add(*trace_);
    }
    if (perfetto_file_.wanted()) {
      perfetto_.emplace(perfetto_file_.stream(), scenario);
      probes_.add(*perfetto_);
    }
    if (pcap_file_.wanted()) {
      pcap_.emplace(
          [this](capture::Bytes bytes) {
            pcap_file_.stream().write(reinterpret_cast<const char*>(bytes.data()),
                                      static_cast<std::streamsize>(bytes.size()));
          },
          scenario);
      probes_.add(*pcap_);
    }
  }

  [[nodiscard]] model::Probe* probe() { return probes_.empty() ? nullptr : &probes_; }

  /// Completes the files; the message of what went wrong, or nothing.
  [[nodiscard]] std::optional<std::string> finish(const model::RunResult& result) {
    if (trace_) trace_->finish(result);
    if (perfetto_) perfetto_->finish();
    for (OutputFile* file : {&trace_file_, &perfetto_file_, &pcap_file_}) {
      if (auto error = file->commit()) return error;
    }
    return std::nullopt;
  }

  /// How far the run went with respect to the limits of the scenario.
  [[nodiscard]] std::vector<props::LimitReading> limits(const model::RunResult& result,
                                                        const model::Scenario& scenario) {
    return limits_.finish(model::trace::known_until(result, scenario));
  }

  [[nodiscard]] std::optional<std::string> open_error() const {
    for (const OutputFile* file : {&trace_file_, &perfetto_file_, &pcap_file_}) {
      if (auto error = file->open_error()) return error;
    }
    return std::nullopt;
  }

 private:
  OutputFile trace_file_;
  OutputFile perfetto_file_;
  OutputFile pcap_file_;
  props::LimitWatch limits_;
  std::optional<model::trace::TraceWriter> trace_;
  std::optional<model::trace::PerfettoWriter> perfetto_;
  std::optional<capture::CaptureProbe> pcap_;
  model::trace::ProbeList probes_;
};

}  // namespace

int simulate(const SimulateArguments& arguments) {
  const auto scenario = model::config::read_scenario(arguments.scenario, arguments.overrides,
                                                     model::config::SpecPath::standard());
  if (!scenario) return complain(to_string(scenario.error()));
  if (arguments.samples || !arguments.compare.empty()) return sample(arguments, *scenario);
  Recorders recorders{arguments, *scenario};
  if (const auto error = recorders.open_error()) return complain(*error);

  model::RunOptions options;
  options.probe = recorders.probe();
  model::RunResult result;
  {
    const InterruptGuard guard;
    ProgressLine progress{arguments.progress.value_or(isatty(STDERR_FILENO) != 0)};
    options.on_progress = [&](const model::Progress& state) {
      progress.update(state);
      return !InterruptGuard::interrupted();
    };
    result = model::simulate(*scenario, options);
  }
  const auto error = recorders.finish(result);
  std::vector<props::LimitReading> limits = recorders.limits(result, *scenario);
  report::Simulation simulation =
      report::describe(arguments.scenario, *scenario, std::move(result));
  simulation.limits = std::move(limits);
  fmt::print("{}", arguments.json ? report::to_json(simulation).dump(2) + "\n"
                                  : report::to_text(report::document_of(simulation)));
  if (error) return complain(*error);
  if (std::ranges::any_of(simulation.limits, &props::LimitReading::exceeded)) return violated;
  return simulation.result.completed() ? established : inconclusive;
}

}  // namespace stormproof::cli
