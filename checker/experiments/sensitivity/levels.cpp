// A level is made in three steps: the changed value, the scenario with it, and the question whether
// a file could say so.
#include "checker/experiments/sensitivity/levels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/implementations.hpp"

namespace stormproof::sensitivity {

namespace {

namespace config = model::config;
using config::NumericKnob;
using model::Deployment;
using model::Participant;
using model::Scenario;

/// `value` · (1 ± range), rounded, and at least 1 away; 0 has no relative step.
std::int64_t stepped(std::int64_t value, Direction direction, double range) {
  if (value == 0) return 0;
  const double factor = direction == Direction::up ? 1 + range : 1 - range;
  const auto scaled = static_cast<std::int64_t>(std::llround(static_cast<double>(value) * factor));
  return direction == Direction::up ? std::max(scaled, value + 1) : std::min(scaled, value - 1);
}

/// A part of the deployment that changes as a whole.
struct DeploymentKnob {
  const char* key;
  const char* doc;
  bool (*exists)(const Scenario&);
  std::string (*value)(const Deployment&);
  void (*change)(Deployment&, Direction, double range);
};

void change_participants(Deployment& deployment, Direction direction, double) {
  std::map<std::uint32_t, std::vector<std::size_t>> by_host;
  for (std::size_t k = 0; k < deployment.participants.size(); ++k) {
    by_host[deployment.participants[k].host.value].push_back(k);
  }
  std::set<std::size_t, std::greater<>> removed;
  for (const auto& [host, members] : by_host) {
    if (direction == Direction::up) {
      deployment.participants.push_back(Participant{deployment.participants[members.back()]});
    } else if (members.size() > 1) {
      removed.insert(members.back());
    }
  }
  for (const std::size_t k : removed) {
    deployment.participants.erase(deployment.participants.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

std::string endpoint_total(const Deployment& deployment) {
  std::uint64_t total = 0;
  for (const Participant& participant : deployment.participants) {
    total += std::uint64_t{participant.publications} + participant.subscriptions;
  }
  return fmt::to_string(total);
}

void change_endpoints(Deployment& deployment, Direction direction, double range) {
  for (Participant& participant : deployment.participants) {
    for (std::uint32_t* endpoints : {&participant.publications, &participant.subscriptions}) {
      *endpoints = static_cast<std::uint32_t>(stepped(*endpoints, direction, range));
    }
  }
}

void step(model::Nanoseconds& time, Direction direction, double range) {
  time = model::Nanoseconds{stepped(time.count(), direction, range)};
}

void change_loopback(Deployment& deployment, Direction direction, double range) {
  step(deployment.loopback_delay, direction, range);
}

void change_schedule(Deployment& deployment, Direction direction, double range) {
  model::Schedule& schedule = *deployment.schedule;
  for (model::Nanoseconds* time : {&schedule.start_min, &schedule.start_max,
                                   &schedule.endpoints_done_min, &schedule.endpoints_done_max}) {
    step(*time, direction, range);
  }
  if (schedule.open_before) step(*schedule.open_before, direction, range);
}

std::string schedule_text(const Deployment& deployment) {
  const model::Schedule& schedule = *deployment.schedule;
  return fmt::format(
      "to {}", config::print_duration(std::max(schedule.start_max, schedule.endpoints_done_max)));
}

constexpr std::array<DeploymentKnob, 4> deployment_knobs{{
    {"deployment.participants", "participants in all; one more or fewer on each host",
     [](const Scenario&) { return true; },
     [](const Deployment& deployment) { return fmt::to_string(deployment.participants.size()); },
     change_participants},
    {"deployment.endpoints", "user endpoints in all; more or fewer for each participant",
     [](const Scenario&) { return true; }, endpoint_total, change_endpoints},
    {"deployment.loopback_delay", "delay of packets to the same host",
     [](const Scenario& scenario) { return model::traits_of(scenario.dds).discovers_same_host; },
     [](const Deployment& deployment) { return config::print_duration(deployment.loopback_delay); },
     change_loopback},
    {"deployment.schedule", "all times that starts and endpoints_done are drawn from",
     [](const Scenario& scenario) { return scenario.deployment.schedule.has_value(); },
     schedule_text, change_schedule},
}};

std::optional<Level> valid(Level level) {
  if (!config::is_valid(level.scenario)) return std::nullopt;
  return level;
}

std::optional<Level> moved(const Scenario& scenario, const DeploymentKnob& knob,
                           Direction direction, double range) {
  Level level{"", scenario, {}};
  Deployment& deployment = level.scenario.deployment;
  knob.change(deployment, direction, range);
  if (deployment == scenario.deployment) return std::nullopt;
  // Participants may have to be given times of their own.
  if (deployment.schedule) deployment.draw_schedule(deployment.schedule->seed);
  level.value = knob.value(deployment);
  return valid(std::move(level));
}

std::optional<Level> moved(const Scenario& scenario, const NumericKnob& knob, Direction direction,
                           double range) {
  const std::int64_t value =
      std::clamp(stepped(knob.value, direction, range), knob.minimum, knob.maximum);
  Level level{config::print_quantity(knob.unit, value), scenario, {}};
  if (value == knob.value || !config::set_numeric_knob(level.scenario, knob.key, value)) {
    return std::nullopt;
  }
  return valid(std::move(level));
}

std::optional<Level> replanned(const Scenario& scenario, Direction direction, double range) {
  const double factor = direction == Direction::up ? 1 + range : 1 - range;
  const auto plan = launch::stepped(launch::plan_of(scenario.deployment), factor);
  if (!plan) return std::nullopt;
  return Level{launch::words_of(*plan), scenario, *plan};
}

std::string obstacle_of(const Knob& knob) {
  if (knob.levels[0] && knob.levels[1]) return "";
  if (knob.levels[0]) return "no valid greater value";
  if (knob.levels[1]) return "no valid smaller value";
  return knob.value.starts_with('0') ? "0 has no relative range" : "no valid other value";
}

}  // namespace

const char* name_of(Direction direction) { return direction == Direction::down ? "down" : "up"; }

std::vector<Knob> knobs_of(const Scenario& scenario, double range) {
  std::vector<Knob> knobs;
  const auto add = [&](Knob knob, const auto& source) {
    for (const Direction direction : directions) {
      knob.levels[static_cast<std::size_t>(direction)] = moved(scenario, source, direction, range);
    }
    knob.obstacle = obstacle_of(knob);
    knobs.push_back(std::move(knob));
  };
  for (const DeploymentKnob& knob : deployment_knobs) {
    if (knob.exists(scenario)) {
      add({knob.key, knob.value(scenario.deployment), knob.doc, {}, ""}, knob);
    }
  }
  if (launch::can_vary(scenario.deployment)) {
    Knob knob{std::string{launch::plan_key},
              launch::words_of(launch::plan_of(scenario.deployment)),
              "when to start which process",
              {},
              ""};
    for (const Direction direction : directions) {
      knob.levels[static_cast<std::size_t>(direction)] = replanned(scenario, direction, range);
    }
    knob.obstacle = obstacle_of(knob);
    knobs.push_back(std::move(knob));
  }
  for (const NumericKnob& knob : config::numeric_knobs(scenario)) {
    add({knob.key, config::print_quantity(knob.unit, knob.value), knob.doc, {}, ""}, knob);
  }
  return knobs;
}

std::optional<Level> moved(const Scenario& scenario, const std::string& key, Direction direction,
                           double range) {
  for (const DeploymentKnob& knob : deployment_knobs) {
    if (key == knob.key && knob.exists(scenario)) return moved(scenario, knob, direction, range);
  }
  if (key == launch::plan_key && launch::can_vary(scenario.deployment)) {
    return replanned(scenario, direction, range);
  }
  for (const NumericKnob& knob : config::numeric_knobs(scenario)) {
    if (key == knob.key) return moved(scenario, knob, direction, range);
  }
  return std::nullopt;
}

}  // namespace stormproof::sensitivity
