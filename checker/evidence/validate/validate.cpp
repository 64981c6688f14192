// Observation, scenario, runs, rows.
#include "checker/evidence/validate/validate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/fastdds/types.hpp"
#include "model/implementations.hpp"

namespace stormproof::validate {

namespace {

using model::config::InputError;
using model::config::quoted_scalar;
using model::config::Result;

constexpr double low_quantile = 0.05;
constexpr double high_quantile = 0.95;

/// A collapse would have the model run for hours. A run that takes this many times as long as what
/// was observed is off by more than any comparison needs; it counts as incomplete.
constexpr std::int64_t longest_run_factor = 5;
constexpr std::int64_t longest_run_least_s = 5;
/// As long as the time limit of a scenario may be.
constexpr std::int64_t longest_run_most_s = 1'000'000;

std::int64_t longest_run_s(const capture::Conversation& conversation, const Request& request) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  const std::int64_t end =
      std::min(request.until_ns.value_or(conversation.last_ns), conversation.last_ns);
  const std::int64_t observed_s = (end - conversation.first_ns) / ns_per_s + 1;
  return std::max(longest_run_least_s, longest_run_factor * observed_s);
}

/// What of a deployment a capture does not show.
constexpr std::array<std::string_view, 4> how_hosts_are_linked{
    "deployment.loopback_delay=", "deployment.hosts=[",
    "deployment.access_points=", "deployment.wired_delay="};

bool says_hosts(const std::string& set) { return set.starts_with("hosts"); }

/// What participants look up, by a version that does, as far as the model has it.
void take_types(const CapturedDeployment& deployment, model::Scenario& scenario) {
  if (!deployment.unknown_types || !model::fastdds::looks_up_types(scenario.dds)) return;
  std::uint64_t unknown = *deployment.unknown_types;
  for (const model::Participant& one : scenario.deployment.participants) {
    unknown = std::min(unknown, model::fastdds::endpoints_with_own_types(one));
  }
  scenario.deployment.types = model::EndpointTypes{static_cast<std::uint32_t>(unknown)};
  if (!model::config::is_valid(scenario)) scenario.deployment.types.reset();  // losses, a server
}

/// The profiles and overrides, around the captured participants. Whose starts are spread, programs
/// take processor time.
Result<model::Scenario> scenario_of(const Request& request, const CapturedDeployment& deployment,
                                    std::int64_t time_limit_s) {
  for (const std::string& set : request.overrides) {
    const auto begins = [&](std::string_view key) { return set.starts_with(key); };
    const bool is_captured =
        (begins("deployment") && std::ranges::none_of(how_hosts_are_linked, begins)) ||
        begins("run_until");
    if (is_captured) {
      return InputError{"--set " + set,
                        "the capture gives the deployment; expected a key of dds or wireless, "
                        "deployment.{loopback_delay, hosts, access_points, wired_delay} or "
                        "time_limit"};
    }
  }
  if (time_limit_s > longest_run_most_s) {
    return InputError{"capture",
                      fmt::format("from its first to its last packet more than {} s pass; are its "
                                  "times damaged? --until INSTANT looks at a part of it",
                                  longest_run_most_s / longest_run_factor)};
  }
  // Apart, so that an error names the profile.
  const auto specs = model::config::SpecPath::standard();
  const auto dds = model::config::read_dds_profile(request.dds, {}, specs);
  if (!dds) return dds.error();
  const auto wireless = model::config::read_wireless_profile(request.wireless, {}, specs);
  if (!wireless) return wireless.error();
  const std::string text = fmt::format(
      "{{deployment: {{hosts: 2, participants_per_host: 1, endpoints_per_participant: 0}}, "
      "dds: {}, wireless: {}, time_limit: {}s}}",
      quoted_scalar(request.dds), quoted_scalar(request.wireless), time_limit_s);
  auto scenario = model::config::parse_scenario(text, "validate", request.overrides, specs);
  if (!scenario) return scenario.error();
  // A profile that leaves it to the network has explained a capture without such packets.
  const auto is_multicast = [](const std::string& set) {
    return set.starts_with("dds.allow_multicast");
  };
  if (dds->allow_multicast == model::AllowMulticast::by_network &&
      std::ranges::none_of(request.overrides, is_multicast)) {
    scenario->dds.allow_multicast = model::AllowMulticast::spdp;
  }
  const bool has_server = model::traits_of(scenario->dds).has_server;
  if (has_server != deployment.server_host.has_value()) {
    return InputError{"--dds", has_server
                                   ? "the profile has a Discovery Server, the capture shows "
                                     "none (PARTICIPANT_TYPE of DATA(p)); expected a "
                                     "profile with `discovery: simple` or `static`"
                                   : "the capture shows a Discovery Server "
                                     "(PARTICIPANT_TYPE of DATA(p)); expected a profile with "
                                     "`discovery: server` or `super_client`"};
  }
  scenario->deployment.participants = model_participants(deployment, scenario->dds.descriptors);
  if (trials::starts_are_spread(scenario->deployment) && trials::lacks_hosts(*scenario)) {
    const auto busy = model::config::parse_scenario(
        text, "validate", trials::with_usual_hosts(request.overrides), specs);
    if (!busy) return busy.error();
    scenario->hosts = busy->hosts;
  }
  take_types(deployment, *scenario);
  if (!model::config::is_valid(*scenario)) {
    return InputError{
        "capture",
        fmt::format("its {} participants, their endpoints or their times are beyond what the model "
                    "takes (at most {} participants)",
                    deployment.participants.size(), model::Deployment::max_participants)};
  }
  return scenario;
}

void use_range(CapturedDeployment& deployment,
               const std::pair<model::Nanoseconds, model::Nanoseconds>& range) {
  for (CapturedParticipant& one : deployment.participants) {
    one.created_earliest = std::max(range.first, one.start);
    one.created_latest = std::max(range.second, one.start);
    one.unevenness = model::Nanoseconds{0};
  }
}

std::optional<double> finite(double value) {
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

/// Whether a run with this profile has the figure: the paper's model has no control traffic, and
/// why a HEARTBEAT is sent is not told apart in messages that mix submessages.
bool is_predicted(Figure figure, const model::ImplementationTraits& traits) {
  switch (figure) {
    case Figure::user_control:
      return traits.has_control_relations;
    case Figure::heartbeat_open:
    case Figure::heartbeat_reply:
    case Figure::heartbeat_piggyback:
    case Figure::heartbeat_periodic:
    case Figure::last_open:
      return !traits.mixes_messages && !traits.has_server;
    case Figure::initial_pulled:  // a client asks for what a server has announced and not yet sent
      return !traits.has_server;
    default:
      return true;
  }
}

std::vector<Row> rows_of(const Observation& observation, const Predicted& predicted,
                         const model::ImplementationTraits& traits, bool is_drawn) {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < figure_count; ++k) {
    const auto figure = static_cast<Figure>(k);
    std::vector<double> values;
    for (const PredictedRun& run : predicted.runs) {
      if (!is_predicted(figure, traits)) continue;
      values.push_back(run.complete ? static_cast<double>(run.tally[k]) : statistics::unreached);
    }
    rows.push_back(row(figure, observation.values[k], std::move(values),
                       is_drawn && predicted.runs.size() > 1));  // one value is no range
  }
  return rows;
}

std::vector<std::array<Band, growth_curves>> bands_of(const std::vector<PredictedRun>& runs) {
  std::vector<std::array<Band, growth_curves>> bands;
  if (runs.empty()) return bands;
  bands.resize(runs.front().growth.points.size());
  for (std::size_t step = 0; step < bands.size(); ++step) {
    for (std::size_t curve = 0; curve < growth_curves; ++curve) {
      std::vector<double> values;
      for (const PredictedRun& run : runs) {
        values.push_back(static_cast<double>(run.growth.points[step][curve]));
      }
      std::ranges::sort(values);
      bands[step][curve] = {statistics::quantile_of_sorted(values, 0.5),
                            statistics::quantile_of_sorted(values, low_quantile),
                            statistics::quantile_of_sorted(values, high_quantile)};
    }
  }
  return bands;
}

}  // namespace

const char* name_of(Position position) {
  constexpr std::array names{"unknown", "below", "inside", "above"};
  return names[static_cast<std::size_t>(position)];
}

const char* name_of(Agreement agreement) {
  constexpr std::array names{"not_asked", "within", "beyond", "undecided"};
  return names[static_cast<std::size_t>(agreement)];
}

Row row(Figure figure, std::optional<double> observed, std::vector<double> values, bool is_drawn) {
  Row result;
  result.figure = figure;
  result.observed = observed;
  if (values.empty()) return result;
  std::ranges::sort(values);
  const double low = statistics::quantile_of_sorted(values, low_quantile);
  const double high = statistics::quantile_of_sorted(values, high_quantile);
  result.median = finite(statistics::quantile_of_sorted(values, 0.5));
  result.low = finite(low);
  result.high = finite(high);
  if (!observed) return result;
  if (result.median && *observed > 0) result.ratio = *result.median / *observed;
  if (!is_drawn || !result.low) return result;
  result.position = *observed < low    ? Position::below
                    : *observed > high ? Position::above
                                       : Position::inside;
  return result;
}

Agreement agreement(const std::vector<Row>& rows, bool observation_is_complete,
                    std::optional<double> within) {
  if (!within) return Agreement::not_asked;
  if (!observation_is_complete) return Agreement::undecided;
  for (const Figure figure : {Figure::completion, Figure::total}) {
    const std::optional<double> ratio = rows[index_of(figure)].ratio;
    if (!ratio) return Agreement::undecided;
  }
  for (const Figure figure : {Figure::completion, Figure::total}) {
    const double ratio = *rows[index_of(figure)].ratio;
    if (ratio > *within || ratio * *within < 1) return Agreement::beyond;
  }
  return Agreement::within;
}

bool is_shown(const Report& report, Figure figure) {
  return !is_of_server(figure) || report.observation.deployment.server_host.has_value();
}

Result<Report> validate(const capture::Conversation& conversation, const Request& request) {
  auto observation = observe(conversation, request.until_ns, request.record);
  if (!observation) return observation.error();
  if (request.endpoints_done) use_range(observation->deployment, *request.endpoints_done);
  auto scenario =
      scenario_of(request, observation->deployment, longest_run_s(conversation, request));
  if (!scenario) return scenario.error();
  Report report;
  report.request = request;
  report.request.sampling.on_progress = {};
  report.usual_hosts = scenario->hosts && std::ranges::none_of(request.overrides, says_hosts);
  report.is_drawn = is_drawn(*scenario, observation->deployment, request.sampling.loss);
  const Predicted predicted = predict(*scenario, *observation, request.sampling);
  report.wanted = predicted.wanted;
  report.runs = predicted.runs.size();
  report.complete =
      static_cast<std::size_t>(std::ranges::count_if(predicted.runs, &PredictedRun::complete));
  report.rows = rows_of(*observation, predicted, model::traits_of(scenario->dds), report.is_drawn);
  report.bands = bands_of(predicted.runs);
  std::vector<Shares> shares;
  for (const PredictedRun& run : predicted.runs) shares.push_back(run.shares);
  report.limiting = limiting(shares);
  report.differences = differences(conversation, *observation, *scenario, predicted.sizes);
  report.agreement = agreement(report.rows, observation->complete, request.within);
  report.scenario =
      draw(*scenario, observation->deployment, request.sampling.loss, request.sampling.first_seed);
  report.observation = std::move(*observation);
  return report;
}

}  // namespace stormproof::validate
