// The scenarios are vectors of the model plus one with relations of more than 64 descriptors.
#include "tests/model/trace/recording.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "model/trace/perfetto.hpp"
#include "model/trace/trace_writer.hpp"
#include "tests/vectors/fastdds_vectors.hpp"
#include "tests/vectors/paper_vectors.hpp"

namespace stormproof::model::trace {

using nlohmann::ordered_json;

Recording record(const Scenario& scenario, const OnProgress& on_progress, Effects effects) {
  Recording recording;
  std::ostringstream out;
  TraceWriter writer{out, scenario, effects};
  RunOptions options;
  options.probe = &writer;
  options.on_progress = on_progress;
  recording.result = simulate(scenario, options);
  writer.finish(recording.result);
  recording.text = out.str();
  std::istringstream in{recording.text};
  for (std::string line; std::getline(in, line);) recording.lines.push_back(line);
  recording.header = ordered_json::parse(recording.lines.front());
  recording.end = ordered_json::parse(recording.lines.back());
  for (std::size_t k = 1; k + 1 < recording.lines.size(); ++k) {
    recording.events.push_back(ordered_json::parse(recording.lines[k]));
  }
  return recording;
}

Timeline record_timeline(const Scenario& scenario, const OnProgress& on_progress, Effects effects) {
  std::ostringstream out;
  PerfettoWriter writer{out, scenario, effects};
  RunOptions options;
  options.probe = &writer;
  options.on_progress = on_progress;
  Timeline timeline;
  timeline.result = simulate(scenario, options);
  writer.finish();
  timeline.document = ordered_json::parse(out.str());
  return timeline;
}

const Recording& recorded(const Case& recorded_case) {
  static std::map<std::string, Recording> recordings;
  const auto [entry, is_new] = recordings.try_emplace(recorded_case.name);
  if (is_new) entry->second = record(recorded_case.scenario());
  return entry->second;
}

const Timeline& recorded_timeline(const Case& recorded_case) {
  static std::map<std::string, Timeline> timelines;
  const auto [entry, is_new] = timelines.try_emplace(recorded_case.name);
  if (is_new) entry->second = record_timeline(recorded_case.scenario());
  return entry->second;
}

const std::vector<Case>& trace_cases() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> list;
    const auto add = [&](const std::string& name, Scenario scenario) {
      // As a file would say it: all endpoints exist from the start, or later.
      for (Participant& p : scenario.deployment.participants) {
        p.endpoints_done = std::max(p.endpoints_done, p.start);
      }
      list.emplace_back(name, std::move(scenario));
    };
    const std::vector<std::string> wanted{"hosts2x1x2",
                                          "hosts3x2x7",
                                          "short_queue",
                                          "at_admission",
                                          "cellular",
                                          "mesh_datagram",
                                          "heartbeat_additive",
                                          "heartbeat_adaptive",
                                          "grouping_mtu",
                                          "constant_delay",
                                          "fast_dds_values_lossy",
                                          "v1",
                                          "v2",
                                          "v3",
                                          "v4"};
    for (const auto& vector : vectors::paper_vectors()) {
      if (std::ranges::find(wanted, vector.name) == wanted.end()) continue;
      Scenario scenario = vector.scenario;
      // The same rules with less to do.
      auto& participants = scenario.deployment;
      if (participants.size() > 8) participants = Deployment::homogeneous(2, 2, 10);
      add(vector.name, scenario);
    }
    for (const auto& vector : vectors::fastdds_vectors()) {
      const bool small = vector.name == "new_only_3x20" || vector.name == "uneven";
      if (small) add("fastdds_" + vector.name, vector.scenario);
    }
    Scenario many;
    many.deployment = Deployment::homogeneous(2, 1, 150);
    add("many_descriptors", many);
    Scenario incomplete = list.front().scenario();
    incomplete.time_limit = Nanoseconds{5'000'000};
    add("incomplete", incomplete);
    return list;
  }();
  return cases;
}

const Scenario& case_named(const std::string& name) {
  for (const Case& c : trace_cases()) {
    if (c.name == name) return c.scenario();
  }
  throw std::invalid_argument{"no case " + name};
}

Scenario living_scenario() {
  Scenario scenario = case_named("fastdds_uneven");
  Life& life = scenario.deployment.life.emplace();
  const std::uint32_t last = scenario.deployment.size() - 1;
  life.stale = {{0, last}};
  life.outages = {{0, last, Nanoseconds{100'000'000}, Nanoseconds{4'000'000'000}}};
  life.lease = Nanoseconds{3'500'000'000};
  life.restarts = {{last, Nanoseconds{5'000'000'000}, Nanoseconds{6'000'000'000}, {}}};
  scenario.run_until = RunUntil::time_limit;
  scenario.time_limit = Nanoseconds{8'000'000'000};
  return scenario;
}

Scenario long_scenario() {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(2, 5, 20);
  return scenario;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace stormproof::model::trace
