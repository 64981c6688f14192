// Comparison of runs with the encoding, and confirmation of counterexamples.
#include "checker/engines/timeline/directed_check.hpp"

#include <map>
#include <set>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "checker/engines/timeline/findings.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/implementations.hpp"
#include "model/simulator.hpp"
#include "props/monitor.hpp"

namespace stormproof::timeline {
namespace {

constexpr std::uint64_t events_of_check = 200'000;

const model::Mutation* mistakes(const checker::CheckRequest& request) {
  return request.mutant != nullptr ? &request.mutant->rules : nullptr;
}

/// The profile that runs: what the mutant makes of the one that the theorem is about.
model::DdsProfile profile_to_run(const model::DdsProfile& dds,
                                 const checker::CheckRequest& request) {
  if (request.mutant == nullptr || !request.mutant->knobs) return dds;
  model::Scenario scenario = request.scenario;
  scenario.dds = dds;
  request.mutant->knobs(scenario);
  return scenario.dds;
}

std::string text(const std::optional<model::Nanoseconds>& time) {
  return time ? fmt::format("{} ns", time->count()) : "never";
}

std::string text(const Prediction& p) {
  return fmt::format("received {}, {} DATA, {} HEARTBEATs, {} ACKNACKs, last packet {}",
                     text(p.received), p.data, p.heartbeats, p.acknacks, text(p.last_packet));
}

/// Why the run differs from what was proved; empty if it does not.
std::string difference(const BoundaryPoint& point, const std::optional<DirectedRun>& run) {
  if (!run) return "the run does not come to an end";
  const Prediction predicted = predict(point.setting, point.director);
  if (std::string why = point.expected(predicted); !why.empty()) {
    return "the encoding contradicts the closed form: " + why;
  }
  const Prediction seen = observe(*run);
  if (seen == predicted) return {};
  return fmt::format("the run has: {}; the rules that were proved about have: {}", text(seen),
                     text(predicted));
}

/// The knobs whose values in the boundary runs are not those of the scenario's profile.
std::string altered_text(const std::vector<BoundaryPoint>& points, const model::DdsProfile& dds) {
  const auto knobs_of = [](const model::DdsProfile& profile) {
    return model::config::effective_json(profile).flatten();  // "/sedp/heartbeat_timer"
  };
  const nlohmann::ordered_json own = knobs_of(dds);
  std::map<std::string, std::set<std::string>> altered;
  for (const BoundaryPoint& point : points) {
    const nlohmann::ordered_json knobs = knobs_of(point.setting.dds);
    for (const auto& [path, value] : knobs.items()) {
      if (own.contains(path) && own[path] == value) continue;
      altered[path.substr(path.rfind('/') + 1)].insert(value.is_string() ? value.get<std::string>()
                                                                         : value.dump());
    }
  }
  std::string text;
  for (const auto& [knob, values] : altered) {
    text += (text.empty() ? "; unlike the scenario's profile they have " : ", ") + knob;
    text += values.size() == 1 ? ": " + *values.begin() : " at other values";
  }
  return text;
}

}  // namespace

model::DdsProfile encoded_profile(const model::DdsProfile& dds) {
  model::DdsProfile encoded = dds;
  encoded.implementation = model::default_implementation;  // whose writer is `of_the_paper`
  encoded.sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
  encoded.sedp.heartbeat_timer = model::HeartbeatTimerKind::single;
  encoded.sedp.relation_opening = model::RelationOpening::receiver;
  encoded.sedp.heartbeat_recipients = model::HeartbeatRecipients::unacknowledged;
  encoded.sedp.piggyback = model::Piggyback::off;
  return encoded;
}

void hold_against_runs(const std::vector<BoundaryPoint>& points, std::string_view property,
                       const checker::CheckRequest& request, props::Finding& finding) {
  std::size_t agree = 0;
  for (const BoundaryPoint& point : points) {
    Setting setting = point.setting;
    setting.dds = profile_to_run(setting.dds, request);
    const auto run = direct(setting, point.director, mistakes(request));
    const std::string why = difference(point, run);
    if (why.empty()) {
      ++agree;
      continue;
    }
    run_contradicts(finding, request, "boundary run \"" + point.name + "\": " + why);
    finding.details.push_back("boundary run \"" + point.name + "\": " + why);
    if (run && !finding.counterexample) {
      finding.counterexample =
          props::Counterexample{std::string{property},
                                run->scenario,
                                run->result.events,
                                run->result.end_time,
                                "The rules do not do what was proved: " + why + ".",
                                {}};
    }
  }
  finding.details.push_back(fmt::format(
      "{} of {} boundary runs of the machines agree with the encoding to the nanosecond{}", agree,
      points.size(), altered_text(points, request.scenario.dds)));
}

std::optional<props::Counterexample> confirmed_counterexample(std::string_view property,
                                                              const model::Scenario& scenario,
                                                              const model::Mutation* mutation) {
  const auto monitor = props::make_monitor(property, scenario);
  if (!monitor) return std::nullopt;
  model::RunOptions options;
  options.probe = monitor.get();
  options.mutation = mutation;
  options.max_events = events_of_check;
  const model::RunResult result = model::simulate(scenario, options);
  // Beyond the last event of a run that has no more, nothing happens.
  const bool known =
      result.end == model::RunEnd::time_limit || result.end == model::RunEnd::no_more_events;
  monitor->finish(known ? scenario.time_limit : result.end_time);
  if (!monitor->violation()) return std::nullopt;
  const props::Violation& v = *monitor->violation();
  return props::Counterexample{std::string{property}, scenario, v.event, v.time, v.reason, {}};
}

}  // namespace stormproof::timeline
