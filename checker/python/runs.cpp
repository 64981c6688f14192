// Runs by the runner of all verbs; what is kept of each is a row.
#include "checker/python/runs.hpp"

#include <atomic>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/experiments/trials/under_seed.hpp"
#include "checker/python/column.hpp"
#include "checker/python/interruptible.hpp"
#include "checker/python/recorder.hpp"
#include "checker/python/scenarios.hpp"
#include "model/simulator.hpp"

namespace stormproof::python {

namespace {

namespace py = pybind11;

constexpr double never = std::numeric_limits<double>::quiet_NaN();

double seconds(const std::optional<model::Nanoseconds>& time) {
  return time ? static_cast<double>(time->count()) * 1e-9 : never;
}

/// One column of what `part` says of each run.
template <class Part>
auto column(const std::vector<trials::Sample>& runs, const Part& part) {
  std::vector<decltype(part(runs.front()))> numbers;
  numbers.reserve(runs.size());
  for (const trials::Sample& run : runs) numbers.push_back(part(run));
  return numbers;
}

py::dict table_of(const std::vector<trials::Sample>& runs) {
  using trials::Sample;
  py::dict table;
  put(table, "seed", column(runs, [](const Sample& run) { return run.seed; }));
  put(table, "completion",
      column(runs, [](const Sample& run) { return seconds(run.discovery_time); }));
  put(table, "took", column(runs, [](const Sample& run) {
        return run.discovery_time ? seconds(run.health.took) : never;
      }));
  put(table, "messages", column(runs, [](const Sample& run) { return run.counts.total(); }));
  for (const model::MessageClass one : model::message_classes) {
    put(table, name_of(one), column(runs, [one](const Sample& run) { return run.counts[one]; }));
  }
  put(table, "user_control", column(runs, [](const Sample& run) { return run.user_control; }));
  put(table, "needless", column(runs, [](const Sample& run) { return run.health.needless; }));
  put(table, "busy", column(runs, [](const Sample& run) { return run.health.busy; }));
  put(table, "events", column(runs, [](const Sample& run) { return run.events; }));
  put(table, "health",
      column(runs, [](const Sample& run) { return static_cast<std::uint8_t>(run.health.health); }));
  return table;
}

/// By the numbers in column `health`.
std::vector<std::string> health_words() {
  std::vector<std::string> words;
  for (const auto health : {exact::Health::fine, exact::Health::slow_link, exact::Health::waiting,
                            exact::Health::storm, exact::Health::incomplete}) {
    words.emplace_back(name_of(health));
  }
  return words;
}

/// Nothing: under the scenario's own seed.
using Seeds = std::optional<std::vector<std::uint64_t>>;

py::dict simulate(const Scenario& scenario, const Seeds& given, double start_jitter_s,
                  std::size_t threads) {
  const std::vector<std::uint64_t> seeds = given.value_or(std::vector{own_seed(scenario.value)});
  const auto jitter = static_cast<std::int64_t>(start_jitter_s * 1e9);
  if (!(start_jitter_s >= 0 && start_jitter_s <= 1e6)) {
    throw py::value_error{"start_jitter: expected seconds, from 0 to 1e6"};
  }
  if (seeds.size() > 1 && jitter == 0 && !model::is_drawn(scenario.value)) {
    throw Refused{{scenario.reference,
                   "all runs would be the same; expected a deployment with ranges of start times "
                   "(schedule), a channel with losses, or start_jitter"}};
  }
  std::atomic<bool> goes_on = true;
  const auto runs = interruptible(
      [&] {
        trials::Runner runner{threads, [&](std::size_t, std::size_t) { return goes_on.load(); }};
        return trials::present(runner.run(seeds.size(), [&](std::size_t k) {
          return trials::sample_run(runner, scenario.value, seeds[k], model::Nanoseconds{jitter});
        }));
      },
      [&] { goes_on = false; });
  return table_of(runs);
}

py::dict record(const Scenario& scenario, const std::optional<std::uint64_t>& seed) {
  model::Scenario drawn = scenario.value;
  if (seed) drawn = trials::under_seed(drawn, *seed);
  std::atomic<bool> goes_on = true;
  Recorder recorder;
  const model::RunResult run = interruptible(
      [&] {
        model::RunOptions options;
        options.probe = &recorder;
        options.on_progress = [&](const model::Progress&) { return goes_on.load(); };
        return model::simulate(drawn, options);
      },
      [&] { goes_on = false; });
  py::dict recording = recorder.tables();
  recording["completion"] = run.discovery_time ? py::object{py::float_(seconds(run.discovery_time))}
                                               : py::object{py::none()};
  recording["end"] = std::string{name_of(run.end)};
  recording["messages"] = run.counts.total();
  recording["events"] = run.events;
  return recording;
}

}  // namespace

void declare_runs(py::module_& module) {
  module.attr("health_words") = health_words();
  module.def("simulate", simulate, py::arg("scenario"), py::arg("seeds") = py::none(),
             py::arg("start_jitter") = 0.0, py::arg("threads") = 0);
  module.def("record", record, py::arg("scenario"), py::arg("seed") = py::none());
}

}  // namespace stormproof::python
