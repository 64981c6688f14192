// Groups runs, derives their schedules and builds their scenarios.
#include "checker/evidence/coverage/configuration.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "checker/evidence/coverage/process_profiles.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"

namespace stormproof::prediction {

namespace {

/// From the beginning of its creation, a participant needs at least this long to announce itself:
/// seen on the live machine when nothing else runs.
constexpr double least_announcement_ms = 3;
/// Creating a participant takes as long as creating so many endpoints: the quotient of the two
/// slopes of ep_done's upper end over N_P and N_P (17 + N_E), 15.4 ms and 0.455 ms, on the live
/// machine.
constexpr double participant_in_endpoints = 34;
/// Endpoints of a ROS 2 node beside the user's.
constexpr double default_endpoints = 17;

/// Medians of both ends, less what the last participant was to start later than the first.
std::optional<Range> median_range(const Configuration& c,
                                  std::optional<Range> Observation::*field) {
  const double spread = c.spread.planned(c.hosts - 1, c.hosts * c.participants_per_host - 1);
  std::vector<double> low;
  std::vector<double> high;
  for (const Observation& run : c.runs) {
    if (!(run.*field)) continue;
    low.push_back((run.*field)->low);
    high.push_back(std::max((run.*field)->low, (run.*field)->high - spread));
  }
  if (low.empty()) return std::nullopt;
  return Range{statistics::median(low), statistics::median(high)};
}

/// A participant of Cyclone DDS hears so long before its first announcement, on the live machine.
constexpr double usual_open_before_ms = 3;

/// The ranges of participants of Cyclone DDS: what was measured, or the fit to the live machine.
ScheduleRanges cyclone_ranges(const Configuration& c) {
  const double participants = c.participants_per_host;
  const double done = 8 * participants + 0.4 * participants * (default_endpoints + c.endpoints);
  ScheduleRanges ranges;
  ranges.start = median_range(c, &Observation::start).value_or(Range{2, 4 * participants});
  ranges.endpoints_done =
      median_range(c, &Observation::endpoints_done).value_or(Range{4, std::max(5.0, done - 15)});
  ranges.open_before = usual_open_before_ms;
  return ranges;
}

/// For runs without ep_done_ms: the fit to the live machine.
Range usual_endpoints_done(double participants, double endpoints) {
  const double low = -0.7 + 2.9 * participants + 0.2 * participants * endpoints;
  const double high = -27 + 15.4 * participants + 0.455 * participants * endpoints;
  return {low, std::max(low, high)};
}

std::string schedule_text(const ScheduleRanges& ranges) {
  const std::string open = ranges.open_before > 0
                               ? fmt::format(", open_before: {:.6f}ms", ranges.open_before)
                               : std::string{};
  return fmt::format(
      ", schedule: {{start: [{:.6f}ms, {:.6f}ms], endpoints_done: [{:.6f}ms, {:.6f}ms]{}}}",
      ranges.start.low, ranges.start.high, ranges.endpoints_done.low, ranges.endpoints_done.high,
      open);
}

std::string scenario_text(const Configuration& c, const ScenarioOptions& options,
                          const std::string& schedule) {
  return fmt::format(
      "{{deployment: {{hosts: {}, participants_per_host: {}, endpoints_per_participant: {}, "
      "loopback_delay: 2ms{}}}, dds: {}, wireless: {}, time_limit: 200s}}",
      c.hosts, c.participants_per_host, c.endpoints, schedule,
      model::config::quoted_scalar(options.dds), model::config::quoted_scalar(options.wireless));
}

bool wants_schedule(const ScenarioOptions& options) {
  return std::ranges::any_of(options.overrides, [](const std::string& set) {
    return set.starts_with("deployment.schedule");
  });
}

template <class Value>
void replace(Value& value, const std::optional<double>& row, double scale) {
  if (row) value = Value{static_cast<std::int64_t>(std::llround(*row * scale))};
}

/// Puts the channel of the row in the place of the profile's.
model::config::Result<model::Scenario> with_channel(model::Scenario scenario,
                                                    const Channel& channel) {
  if (channel.wired()) {
    const auto wired =
        model::config::read_wireless_profile("wired", {}, model::config::SpecPath::standard());
    if (!wired) return wired.error();
    scenario.wireless = *wired;
  } else {
    replace(scenario.wireless.overhead_unicast, channel.overhead_unicast_us, 1e3);
    replace(scenario.wireless.overhead_multicast, channel.overhead_multicast_us, 1e3);
    replace(scenario.wireless.rate_unicast, channel.rate_unicast_mbps, 1e6);
    replace(scenario.wireless.rate_multicast, channel.rate_multicast_mbps, 1e6);
  }
  if (channel.send_buffer_bytes.value_or(0) > 0) {
    replace(scenario.dds.sedp.piggyback_threshold_bytes, channel.send_buffer_bytes, 1);
  }
  return scenario;
}

}  // namespace

std::vector<Configuration> configurations(const std::vector<Observation>& rows) {
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::string, Channel,
                         std::optional<std::uint32_t>, Spread, std::optional<std::uint32_t>, bool,
                         std::vector<std::string>, Change>;
  std::map<Key, Configuration> found;
  for (const Observation& run : rows) {
    Configuration& c = found[Key{run.participants_per_host, run.endpoints, run.hosts, run.set,
                                 run.channel, run.peer_range, run.spread, run.unknown_types,
                                 run.looks_up_types, run.profiles, run.change}];
    c.set = run.set;
    c.hosts = run.hosts;
    c.participants_per_host = run.participants_per_host;
    c.endpoints = run.endpoints;
    c.channel = run.channel;
    c.peer_range = run.peer_range;
    c.unknown_types = run.unknown_types;
    c.looks_up_types = run.looks_up_types;
    c.spread = run.spread;
    c.change = run.change;
    c.profiles = run.profiles;
    c.runs.push_back(run);
  }
  std::vector<Configuration> result;
  for (auto& [key, configuration] : found) result.push_back(std::move(configuration));
  return result;
}

std::optional<double> Configuration::limit() const {
  double longest = 0;
  for (const Observation& run : runs) {
    if (!run.completed) longest = std::max(longest, *run.values[0]);
  }
  return longest > 0 ? std::optional{longest} : std::nullopt;
}

ScheduleRanges schedule_ranges(const Configuration& c, model::Writer writer) {
  if (writer == model::Writer::of_cyclone) return cyclone_ranges(c);
  const double endpoints = default_endpoints + c.endpoints;
  ScheduleRanges ranges;
  ranges.endpoints_done = median_range(c, &Observation::endpoints_done)
                              .value_or(usual_endpoints_done(c.participants_per_host, endpoints));
  if (const auto measured = median_range(c, &Observation::start)) {
    ranges.start = *measured;
    return ranges;
  }
  const Range create = median_range(c, &Observation::create).value_or(Range{});
  const double creation_share = participant_in_endpoints / (participant_in_endpoints + endpoints);
  ranges.start.low = create.low + least_announcement_ms;
  ranges.start.high = std::max(ranges.start.low, ranges.endpoints_done.high * creation_share);
  return ranges;
}

StartTimes start_times(const Configuration& configuration, const model::Scenario& scenario,
                       const ScenarioOptions& options) {
  std::vector<std::vector<Times>> measured;
  const bool start_matters = model::traits_of(scenario.dds).creates_endpoints_over_time ||
                             configuration.spread.step_ms > 0;
  if (start_matters && !wants_schedule(options)) {
    for (const Observation& run : configuration.runs) {
      if (run.participants.size() != scenario.deployment.size()) continue;
      measured.push_back(run.participants);
    }
  }
  return {configuration.spread, std::move(measured)};
}

model::config::Result<model::Scenario> scenario_of(const Configuration& configuration,
                                                   const ScenarioOptions& options) {
  const auto specs = model::config::SpecPath::standard();
  std::vector<std::string> overrides = options.overrides;
  const auto read = [&](const std::string& schedule) {
    return model::config::parse_scenario(scenario_text(configuration, options, schedule),
                                         "coverage", overrides, specs);
  };
  const model::Writer usual = model::Writer::stateful;
  auto scenario = read(schedule_text(schedule_ranges(configuration, usual)));
  if (!scenario) return scenario.error();
  const bool takes_time = configuration.spread.step_ms > 0 && !configuration.change.happens();
  if (takes_time && trials::lacks_hosts(*scenario)) {
    overrides = trials::with_usual_hosts(std::move(overrides));
    scenario = read(schedule_text(schedule_ranges(configuration, usual)));
    if (!scenario) return scenario.error();
  }
  if (const model::Writer writer = model::traits_of(scenario->dds).writer; writer != usual) {
    scenario = read(schedule_text(schedule_ranges(configuration, writer)));
    if (!scenario) return scenario.error();
  }
  if (!model::traits_of(scenario->dds).creates_endpoints_over_time && !wants_schedule(options)) {
    scenario = read("");
    if (!scenario) return scenario.error();
  }
  if (configuration.peer_range && scenario->dds.discovery == model::Discovery::static_peers) {
    scenario->dds.peer_ports = *configuration.peer_range;
  }
  if (model::fastdds::looks_up_types(scenario->dds)) {
    model::Deployment& deployment = scenario->deployment;
    if (!configuration.looks_up_types) scenario->dds.version.type_lookup = model::Whether::no;
    const bool has_types =
        configuration.unknown_types && !model::traits_of(scenario->dds).has_server;
    if (has_types && !deployment.types)
      deployment.types = model::EndpointTypes{*configuration.unknown_types};
  }
  if (const auto limit = configuration.limit()) {
    scenario->time_limit = nanoseconds(*limit);
  }
  if (auto error = give_profiles(configuration, options, *scenario)) return *std::move(error);
  put(configuration.change, configuration.participants_per_host, *scenario);
  if (options.channel == ChannelSource::profile) return scenario;
  return with_channel(std::move(*scenario), configuration.channel);
}

std::string mismatch(const Configuration& configuration, const model::Scenario& scenario,
                     bool by_channel) {
  if (configuration.change.happens() && !model::config::is_valid(scenario)) {
    return configuration.change.outage ? "an outage" : "a process that goes";
  }
  if (!by_channel) return "";
  const Channel& row = configuration.channel;
  const model::WirelessProfile& profile = scenario.wireless;
  if (row.medium && row.wired() != (profile.kind == model::ServiceKind::constant_delay)) {
    return "medium " + *row.medium;
  }
  const auto differs = [](const std::optional<double>& value, double scale, std::int64_t wanted) {
    return value && std::llround(*value * scale) != wanted;
  };
  if (differs(row.overhead_unicast_us, 1e3, profile.overhead_unicast.count())) {
    return fmt::format("O_u_us {}", *row.overhead_unicast_us);
  }
  if (differs(row.overhead_multicast_us, 1e3, profile.overhead_multicast.count())) {
    return fmt::format("O_m_us {}", *row.overhead_multicast_us);
  }
  if (differs(row.rate_unicast_mbps, 1e6, profile.rate_unicast.count())) {
    return fmt::format("R_u_Mbps {}", *row.rate_unicast_mbps);
  }
  if (differs(row.rate_multicast_mbps, 1e6, profile.rate_multicast.count())) {
    return fmt::format("R_m_Mbps {}", *row.rate_multicast_mbps);
  }
  if (row.loss.value_or(0) > 0) return fmt::format("loss {}", *row.loss);
  // The default send buffer of Linux is 212,992 B, of which the writer takes half.
  const double buffer = row.send_buffer_bytes.value_or(0);
  const double threshold = buffer > 0 ? buffer : 106'496;
  if (differs(row.send_buffer_bytes ? std::optional{threshold} : std::nullopt, 1,
              scenario.dds.sedp.piggyback_threshold_bytes.count())) {
    return buffer > 0 ? fmt::format("sndbuf_B {:.0f}", buffer) : "sndbuf_B 0 (the default)";
  }
  return "";
}

}  // namespace stormproof::prediction
