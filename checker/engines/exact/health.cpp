// One word for a run: what it took beside what everything sent once takes.
#include "checker/engines/exact/health.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "checker/presentation/text/numbers.hpp"
#include "model/life.hpp"
#include "model/reference.hpp"
#include "model/simulator.hpp"

namespace stormproof::exact {

using model::Nanoseconds;
using model::TrafficClass;

namespace {

bool has_failures(const model::Deployment& deployment) {
  const auto& life = deployment.life;
  return life && !(life->mute.empty() && life->outages.empty() && life->restarts.empty());
}

PerClass messages_of(const model::RunResult& result) {
  PerClass sum{};
  const auto put = [&](TrafficClass one, std::uint64_t messages) {
    sum[static_cast<std::size_t>(one)] = static_cast<double>(messages);
  };
  put(TrafficClass::spdp, result.counts.spdp() + result.counts.of_server());
  put(TrafficClass::initial_data, result.counts.initial_data);
  put(TrafficClass::repair_data, result.counts.repair_data);
  put(TrafficClass::heartbeat, result.counts.heartbeat);
  put(TrafficClass::acknack, result.counts.acknack);
  put(TrafficClass::user_control, result.user_control);
  put(TrafficClass::lookup, result.counts.lookup);
  return sum;
}
/// Of all channels.
PerClass airtime_of(const model::RunResult& result) {
  PerClass sum{};
  for (const model::ChannelUse& channel : result.channels) {
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += static_cast<double>(channel.busy[k].count());
    }
  }
  return sum;
}

double needed_repairs(const model::RunResult& result) {
  if (result.repairs_received == 0) return 1;
  return part_of(static_cast<double>(result.useful_repairs),
                 static_cast<double>(result.repairs_received));
}

double busiest(const model::RunResult& result) {
  Nanoseconds most;
  for (const model::ChannelUse& channel : result.channels) {
    most = std::max(most, channel.total_busy());
  }
  const auto passed = static_cast<double>(std::max<std::int64_t>(result.end_time.count(), 1));
  return std::min(1.0, static_cast<double>(most.count()) / passed);
}

/// Beside the limit of the scenario, if it sets one; otherwise by what people wait for.
bool is_slow(const RunHealth& run, const std::optional<model::Limits>& limits) {
  if (limits && limits->completion) return *run.completion > *limits->completion;
  return run.took > late_limit(limits);
}

Health judged(const RunHealth& run, const Expense& took,
              const std::optional<model::Limits>& limits) {
  if (is_storm(took, limits)) return Health::storm;
  if (!run.completion) return Health::incomplete;
  if (!is_slow(run, limits)) return Health::fine;
  return run.busy >= 0.5 ? Health::slow_link : Health::waiting;
}

std::string after_last_start(const RunHealth& run) {
  if (run.last_start.count() == 0) return "after " + report::duration(run.took);
  return report::duration(run.took) +
         (run.has_failures ? " after the last failure or start" : " after the last start");
}

}  // namespace

const char* name_of(Health health) {
  switch (health) {
    case Health::fine:
      return "fine";
    case Health::slow_link:
      return "slow_link";
    case Health::waiting:
      return "waiting";
    case Health::storm:
      return "storm";
    case Health::incomplete:
      return "incomplete";
  }
  return "";
}

const char* headline_of(Health health) {
  switch (health) {
    case Health::fine:
      return "FINE";
    case Health::slow_link:
      return "SLOW LINK";
    case Health::waiting:
      return "SLOW";
    case Health::storm:
      return "STORM";
    case Health::incomplete:
      return "INCOMPLETE";
  }
  return "";
}

RunHealth health_of(const model::Scenario& scenario, const model::RunResult& result) {
  const bool goes_on = scenario.run_until != model::RunUntil::completion;
  if (goes_on && result.completed() && result.end != model::RunEnd::completed) {
    // What the channels carried after discovery does not count. Where somebody may still be
    // forgotten no run ends with it.
    model::Scenario discovery = scenario;
    discovery.run_until = model::RunUntil::completion;
    return health_of(discovery, model::simulate(discovery));
  }
  RunHealth run;
  run.completion = result.discovery_time;
  run.last_start = model::last_failure(scenario.deployment);
  run.has_failures = has_failures(scenario.deployment);
  run.missing = result.missing_count;
  const bool cut = result.end == model::RunEnd::interrupted;
  const Nanoseconds end =
      result.discovery_time.value_or(cut ? result.end_time : scenario.time_limit);
  run.took = std::max(end - run.last_start, Nanoseconds{});
  run.busy = busiest(result);
  if (const auto once = model::open_loop_airtime(scenario); once && once->count() > 0) {
    run.stretch = static_cast<double>(run.took.count()) / static_cast<double>(once->count());
  }
  const PerClass airtime = airtime_of(result);
  const PerClass messages = messages_of(result);
  const bool has_airtime = !result.channels.empty();
  const Sent sent = sent_of(has_airtime ? airtime : messages, messages,
                            model::failure_free_reference(scenario), needed_repairs(result));
  const Expense took = expense_of(sent, !run.completion || run.took > late_limit(scenario.limits));
  run.needless = took.ratio();
  if (has_airtime && took.once > 0) {
    run.airtime = std::accumulate(airtime.begin(), airtime.end(), 0.0) / took.once;
  }
  run.health = judged(run, took, scenario.limits);
  return run;
}

Outlook::Outlook(std::vector<RunHealth> runs) : runs_{std::move(runs)} {
  std::ranges::stable_sort(runs_, [](const RunHealth& a, const RunHealth& b) {
    if (!a.completion != !b.completion) return a.completion.has_value();
    return a.completion ? a.took < b.took : a.missing < b.missing;
  });
}

std::size_t Outlook::count(Health health) const {
  return static_cast<std::size_t>(std::ranges::count(runs_, health, &RunHealth::health));
}

std::size_t Outlook::completed() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      runs_, [](const RunHealth& run) { return run.completion.has_value(); }));
}

Health Outlook::health() const { return count(Health::storm) > 0 ? Health::storm : worst().health; }

std::string Outlook::headline() const {
  const Health health = this->health();
  const std::size_t number = count(health);
  if (number == size()) return headline_of(health);
  return fmt::format("{} in {} of {} runs", headline_of(health), number, size());
}

std::string Outlook::sentence() const {
  const RunHealth& run = median();
  if (size() > 1) {
    if (completed() < size()) {
      return fmt::format("discovery does not complete in {} of {} runs", size() - completed(),
                         size());
    }
    return fmt::format("discovery completes {} at the median of {} runs, {} to {}",
                       after_last_start(run), size(), report::duration(best().took),
                       report::duration(worst().took));
  }
  std::string text = run.completion ? "discovery completes " + after_last_start(run)
                                    : "discovery is not complete " + after_last_start(run);
  switch (run.health) {
    case Health::storm:
      return text + fmt::format(
                        "; needless repeats and the control traffic that they cause take {} the "
                        "airtime of everything sent once",
                        report::ratio(run.needless, 1));
    case Health::slow_link:
      return text +
             fmt::format("; the channel is busy {} of the time", report::percent(run.busy, 1));
    case Health::waiting:
      return text + fmt::format(
                        "; the channel is busy only {} of the time, the rest is waiting for "
                        "timers and processes",
                        report::percent(run.busy, 1));
    case Health::fine:
    case Health::incomplete:
      break;
  }
  return text;
}

}  // namespace stormproof::exact
