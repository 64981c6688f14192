// Scenarios and where they break their properties.
#include "tests/checker/verification/counterexample/examples.hpp"

#include <stdexcept>

#include "checker/verification/counterexample/observe.hpp"
#include "model/config/scenario_file.hpp"
#include "model/engine/packet.hpp"

namespace stormproof::counterexample {

void FirstRepair::event_started(const model::Event& event) {
  ++events_;
  now_ = event.time;
}

void FirstRepair::emitted(const model::Packet& packet, std::uint32_t,
                          std::span<const std::uint32_t>) {
  if (packet.from_repair) object(events_ - 1, now_, "The first repair is sent.");
}

model::Scenario scenario_named(const std::string& name, const std::vector<std::string>& overrides) {
  const auto scenario = model::config::read_scenario(
      name, overrides, model::config::SpecPath{{STORMPROOF_SPECS_DIR}});
  if (!scenario) throw std::runtime_error(to_string(scenario.error()));
  return *scenario;
}

namespace {

props::Counterexample observed(props::Monitor& monitor, const model::Scenario& scenario) {
  const auto found = observe(scenario, monitor);
  if (!found) throw std::runtime_error("the scenario does not break the property");
  return {std::string{monitor.property()}, scenario, found->event, found->time, found->reason, {}};
}

}  // namespace

props::Counterexample counterexample_of(const std::string& property,
                                        const model::Scenario& scenario) {
  const auto monitor = props::make_monitor(property, scenario);
  if (!monitor) throw std::runtime_error("no monitor for " + property);
  return observed(*monitor, scenario);
}

props::Counterexample smallest() {
  return counterexample_of("storm.free-threshold", scenario_named("smallest"));
}

props::Counterexample additive() {
  return counterexample_of(
      "timer.single-heartbeat",
      scenario_named("smallest",
                     {"deployment={hosts: 2, participants_per_host: 2, endpoints_per_participant: "
                      "10}",
                      "dds.sedp.heartbeat_timer=additive"}));
}

props::Counterexample lossy() {
  FirstRepair monitor;
  return observed(
      monitor, scenario_named("smallest", {"wireless.kind=constant_delay", "wireless.one_way=30us",
                                           "dds.sedp.piggyback=off", "wireless.lost_packets=[4]"}));
}

props::Counterexample delayed() {
  model::Scenario scenario =
      scenario_named("smallest", {"wireless.kind=constant_delay", "wireless.one_way=30us"});
  scenario.wireless.packet_delays = {
      {4, model::Nanoseconds{20'000}, model::Nanoseconds{30'000'000}}};
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = model::Nanoseconds{1'000'000'000};
  return counterexample_of("storm.single-copy", scenario);
}

props::Counterexample fastdds() {
  return counterexample_of("timer.suppression-honoured", scenario_named("wifi-5x20-fastdds"));
}

props::Counterexample storm() {
  return counterexample_of("storm.single-copy", scenario_named("three-hosts"));
}

const std::vector<Example>& examples() {
  static const std::vector<Example> all{
      {example_names[0], smallest()}, {example_names[1], additive()},
      {example_names[2], lossy()},    {example_names[3], fastdds()},
      {example_names[4], storm()},    {example_names[5], delayed()}};
  return all;
}

}  // namespace stormproof::counterexample
