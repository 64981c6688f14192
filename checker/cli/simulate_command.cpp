// `stormproof simulate SCENARIO`: reads the scenario, runs it with the observers that were asked
// for and those of its limits.
#include "checker/cli/commands.hpp"
#include "checker/cli/simulate_request.hpp"
#include "checker/evidence/capture/write/capture_probe.hpp"
#include "checker/experiments/simulate/sample_report.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/check/next_steps.hpp"
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
  Recorders(SimulateArguments& arguments, const model::Scenario& scenario) : limits_{scenario} {
    for (model::Probe* probe : limits_.probes()) probes_.add(*probe);
    const auto effects =
        arguments.effects ? model::trace::Effects::named : model::trace::Effects::left_out;
    if (arguments.trace.wanted()) {
      trace_.emplace(arguments.trace.stream(), scenario, effects);
      probes_.add(*trace_);
    }
    if (arguments.perfetto.wanted()) {
      perfetto_.emplace(arguments.perfetto.stream(), scenario, effects);
      probes_.add(*perfetto_);
    }
    if (arguments.pcap.wanted()) {
      pcap_.emplace(
          [&out = arguments.pcap.stream()](capture::Bytes bytes) {
            out.write(reinterpret_cast<const char*>(bytes.data()),
                      static_cast<std::streamsize>(bytes.size()));
          },
          scenario);
      probes_.add(*pcap_);
    }
  }

  [[nodiscard]] model::Probe* probe() { return probes_.empty() ? nullptr : &probes_; }

  /// What the files still need.
  void finish(const model::RunResult& result) {
    if (trace_) trace_->finish(result);
    if (perfetto_) perfetto_->finish();
  }

  /// How far the run went with respect to the limits of the scenario.
  [[nodiscard]] std::vector<props::LimitReading> limits(const model::RunResult& result,
                                                        const model::Scenario& scenario) {
    return limits_.finish(model::trace::known_until(result, scenario));
  }

 private:
  props::LimitWatch limits_;
  std::optional<model::trace::TraceWriter> trace_;
  std::optional<model::trace::PerfettoWriter> perfetto_;
  std::optional<capture::CaptureProbe> pcap_;
  model::trace::ProbeList probes_;
};

/// Start times that are drawn could have been others: one run of a storm says little.
std::vector<trials::Sample> other_draws(const model::Scenario& scenario, Session& session) {
  trials::SampleOptions options;
  options.samples = trials::usual_samples;
  options.first_seed = model::own_seed(scenario);
  options.on_progress = session.on_runs();
  return trials::sample_runs(scenario, options);
}

Outcome run(SimulateArguments& arguments, Session& session) {
  if (arguments.effects && !arguments.trace.wanted() && !arguments.perfetto.wanted()) {
    return model::config::InputError{"--effects",
                                     "it names effects in a recording; expected --trace FILE or "
                                     "--perfetto FILE with it"};
  }
  const auto scenario = model::config::read_scenario(arguments.scenario, arguments.overrides,
                                                     model::config::SpecPath::standard());
  if (!scenario) return scenario.error();
  if (arguments.samples || !arguments.compare.empty() || !arguments.start_jitter.empty()) {
    return sample(arguments, *scenario, session);
  }
  Recorders recorders{arguments, *scenario};
  model::RunOptions options;
  options.probe = recorders.probe();
  options.on_progress = session.on_simulation();
  model::RunResult result = model::simulate(*scenario, options);
  recorders.finish(result);
  std::vector<props::LimitReading> limits = recorders.limits(result, *scenario);
  report::Simulation simulation =
      report::describe(arguments.scenario, *scenario, std::move(result));
  simulation.limits = std::move(limits);
  simulation.words = checker::words_of(arguments.scenario, arguments.overrides);
  const bool recorded =
      arguments.trace.wanted() || arguments.perfetto.wanted() || arguments.pcap.wanted();
  if (model::is_drawn(*scenario) && !recorded) {
    simulation.samples = other_draws(*scenario, session);
  }
  Answer answer;
  answer.document = document_of(simulation);
  Session::note_interruption(answer.document);
  answer.json = to_json(simulation);
  return answer;
}

void declare(Options& options, SimulateArguments& arguments) {
  options.scenario(arguments.scenario, arguments.overrides);
  const Option recordings[] = {
      options.output("--trace", arguments.trace, "Write every event as JSON Lines"),
      options.output("--perfetto", arguments.perfetto, "Write a trace that ui.perfetto.dev opens"),
      options.output("--pcap", arguments.pcap,
                     "Write the packets as a capture, for Wireshark and stormproof capture"),
      options
          .flag("--effects", arguments.effects,
                "Name in --trace and --perfetto which effect of the rules sends each packet and "
                "starts each timer (ids of stormproof draw composition)")
          .not_repeated()};
  const Option samples =
      options
          .number("--samples", arguments.samples,
                  "Run N schedules drawn from deployment.schedule, on all cores (default 12)", "N")
          .within(1, 1'000'000);
  options.number("--seed", arguments.seed, "Seed of the first sampled schedule", "S")
      .needs(samples);
  const Option compare = options.texts(
      "--compare", arguments.compare,
      "Run another DDS profile on the same schedules, side by side (repeatable)", "PROFILE");
  const Option jitter = options.start_jitter(arguments.start_jitter);
  for (const Option& recording : recordings) {
    recording.excludes(samples).excludes(compare).excludes(jitter);
  }
}

}  // namespace

void declare_simulate(Frame& frame) {
  frame.add<SimulateArguments>(
      {"simulate",
       "Predict the discovery of a scenario: completion time, messages, channel use",
       "Exit code: 0 discovery completes (in every run), 1 a limit of the scenario is exceeded,\n"
       "3 it does not complete within the time limit, 2 bad input.",
       Formats::findings,
       {report::simulation_schema, report::sampling_schema}},
      declare, run);
}

}  // namespace stormproof::cli
