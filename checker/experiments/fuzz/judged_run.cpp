// Runs and their judgments.
#include "checker/experiments/fuzz/judged_run.hpp"

#include <algorithm>
#include <iterator>

#include "checker/engines/exact/observed_run.hpp"
#include "model/engine/packet.hpp"
#include "model/reference.hpp"
#include "model/simulator.hpp"
#include "model/trace/probe_list.hpp"
#include "model/trace/replay.hpp"
#include "props/monitor.hpp"

namespace stormproof::fuzz {

namespace {

class PacketCounter final : public model::Probe {
 public:
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    packets_ = packet.number + packet.copies;
  }
  [[nodiscard]] std::uint64_t packets() const { return packets_; }

 private:
  std::uint64_t packets_ = 0;
};

using Monitors = std::vector<std::unique_ptr<props::Monitor>>;

Monitors monitors_of(std::span<const std::string_view> ids, const model::Scenario& scenario) {
  Monitors monitors;
  for (const std::string_view id : ids) {
    if (id == exact::quiescence) continue;
    if (auto monitor = props::make_monitor(id, scenario)) monitors.push_back(std::move(monitor));
  }
  return monitors;
}

void note(const props::Monitor& monitor, std::string_view id, JudgedRun& run) {
  const auto& found = monitor.violation();
  if (found) run.breaches.push_back({id, found->event, found->time, found->reason});
}

/// What the first `packets` packets lose, and what the scenario itself loses.
std::vector<std::uint64_t> united(const std::vector<std::uint64_t>& a,
                                  const std::vector<std::uint64_t>& b) {
  std::vector<std::uint64_t> both;
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

std::uint64_t count_below(const std::vector<std::uint64_t>& ascending, std::uint64_t limit) {
  return static_cast<std::uint64_t>(std::ranges::lower_bound(ascending, limit) - ascending.begin());
}

JudgedRun summary(const model::Scenario& scenario, const model::RunResult& result) {
  JudgedRun run;
  run.discovery_time = result.discovery_time;
  run.messages = result.counts.total();
  run.amplification = static_cast<double>(run.messages) /
                      static_cast<double>(model::failure_free_reference(scenario).total());
  for (const model::BacklogPeak& peak : result.backlog) {
    run.backlog = std::max(run.backlog, peak.packets);
  }
  run.events = result.events;
  run.health = exact::health_of(scenario, result);
  return run;
}

}  // namespace

const Breach* JudgedRun::breach(std::string_view id) const {
  const auto found = std::ranges::find(breaches, id, &Breach::id);
  return found == breaches.end() ? nullptr : &*found;
}

bool JudgedRun::decides(std::string_view id) const {
  return std::ranges::find(undecided, id) == undecided.end();
}

std::optional<JudgedRun> run_and_judge(model::Scenario& scenario,
                                       std::span<const std::string_view> ids, const Losses& losses,
                                       std::uint64_t expected, const GoesOn& goes_on) {
  const std::vector<std::uint64_t> own = scenario.wireless.lost_packets;
  JudgedRun run;
  const bool quiet_too = std::ranges::find(ids, exact::quiescence) != ids.end();
  for (std::uint64_t packets = std::max<std::uint64_t>(expected, 1);; packets *= 2) {
    std::vector<std::uint64_t> drawn = losses ? losses(packets) : own;
    scenario.wireless.lost_packets = united(own, drawn);
    const Monitors monitors = monitors_of(ids, scenario);
    PacketCounter counter;
    model::trace::ProbeList probes;
    probes.add(counter);
    for (const auto& monitor : monitors) probes.add(*monitor);
    model::RunOptions options;
    options.probe = &probes;
    options.on_progress = [&](const model::Progress&) { return !goes_on || goes_on(); };
    const model::RunResult result = model::simulate(scenario, options);
    if (result.end == model::RunEnd::interrupted) return std::nullopt;
    if (losses && counter.packets() > packets) continue;
    run = summary(scenario, result);
    run.packets = counter.packets();
    run.lost = count_below(scenario.wireless.lost_packets, run.packets);
    if (!quiet_too) {  // what was never emitted need not be lost
      drawn.resize(count_below(drawn, run.packets));
      scenario.wireless.lost_packets = united(own, drawn);
    }
    for (const auto& monitor : monitors) {
      monitor->finish(model::trace::known_until(result, scenario));
      note(*monitor, monitor->property(), run);
      if (monitor->is_undecided()) run.undecided.push_back(monitor->property());
    }
    break;
  }
  if (!quiet_too) return run;
  const exact::RunPlan plan{scenario, scenario, nullptr, 0, goes_on};
  const exact::ObservedRun quiet = exact::run_until_quiet(plan);
  if (goes_on && !goes_on()) return std::nullopt;
  note(*quiet.monitors.front(), exact::quiescence, run);
  return run;
}

std::optional<props::Counterexample> find_breach(const model::Scenario& scenario,
                                                 std::string_view id, std::uint64_t most_events,
                                                 std::uint64_t& events, const GoesOn& goes_on) {
  props::Counterexample found;
  found.property = id;
  found.scenario = scenario;
  std::optional<props::Violation> violation;
  if (id == exact::quiescence) {
    const exact::RunPlan plan{scenario, scenario, nullptr, most_events, goes_on};
    exact::ObservedRun run = exact::run_until_quiet(plan);
    events += run.result.events;
    violation = run.monitors.front()->violation();
    found.scenario = std::move(run.scenario);
  } else {
    const auto monitor = props::make_monitor(id, scenario);
    if (!monitor) return std::nullopt;
    model::RunOptions options;
    options.probe = monitor.get();
    options.max_events = most_events;
    options.on_progress = [&](const model::Progress&) {
      return !monitor->violation() && (!goes_on || goes_on());
    };
    const model::RunResult result = model::simulate(scenario, options);
    events += result.events;
    if (result.end != model::RunEnd::interrupted) {
      monitor->finish(model::trace::known_until(result, scenario));
    }
    violation = monitor->violation();
  }
  if (!violation) return std::nullopt;
  found.event = violation->event;
  found.time = violation->time;
  found.reason = violation->reason;
  return found;
}

}  // namespace stormproof::fuzz
