// The configurations that were measured, and the scenario that predicts each of them: who takes
// part, when participants start, and over which channel.
#pragma once

#include <string>
#include <vector>

#include "checker/evidence/coverage/observation.hpp"
#include "checker/evidence/coverage/start_times.hpp"
#include "model/implementations.hpp"
#include "model/scenario.hpp"

namespace stormproof::prediction {

/// All runs of one set with the same numbers, the same channel, the same spread of starts and the
/// same happening to them.
struct Configuration {
  std::string set;
  std::uint32_t hosts = 0;
  std::uint32_t participants_per_host = 0;  ///< N_P
  std::uint32_t endpoints = 0;              ///< N_E
  Channel channel;
  std::optional<std::uint32_t> peer_range = {};     ///< ports of each host, of static peers
  std::optional<std::uint32_t> unknown_types = {};  ///< as in `Observation`
  bool looks_up_types = true;
  Spread spread = {};
  Change change = {};
  std::vector<std::string> profiles;  ///< as in `Observation`
  std::vector<Observation> runs;

  [[nodiscard]] bool same_deployment(const Configuration& other) const {
    return hosts == other.hosts && participants_per_host == other.participants_per_host &&
           endpoints == other.endpoints && spread == other.spread && change == other.change;
  }
  /// The limit of runs that did not complete, the longest of them, in ms; nothing if all did, or
  /// no limit is known.
  [[nodiscard]] std::optional<double> limit() const;
};

/// In ascending order of N_P, N_E, hosts, set, channel and spread; runs in the order of the file.
[[nodiscard]] std::vector<Configuration> configurations(const std::vector<Observation>& rows);

/// Where the schedules of a configuration are drawn from, in ms. The rule, in
/// specs/guide/coverage.md, is the same for every configuration and every machine; what was not
/// measured depends on whose participants they are.
struct ScheduleRanges {
  Range start;
  Range endpoints_done;
  double open_before = 0;  ///< how long before its start a participant hears
};
[[nodiscard]] ScheduleRanges schedule_ranges(const Configuration& configuration,
                                             model::Writer writer = model::Writer::stateful);

/// Whose channel a prediction uses: the wireless profile's, or that of the row.
enum class ChannelSource : std::uint8_t { profile, row };

struct ScenarioOptions {
  std::string dds;                     ///< name or path of a profile
  std::string wireless;                ///< name or path of a profile
  std::vector<std::string> overrides;  ///< key.path=value
  ChannelSource channel = ChannelSource::profile;
  std::vector<std::string> words = {};  ///< "WORD=PROFILE": what processes run by the words of rows
};

/// When participants start in samples of the scenario of a configuration: as in the measured runs,
/// if they say so and nobody asked for a schedule.
[[nodiscard]] StartTimes start_times(const Configuration& configuration,
                                     const model::Scenario& scenario,
                                     const ScenarioOptions& options);

/// The scenario of a configuration; with static peers, announcements go to as many ports as were
/// measured, and of a profile whose participants look up types they know as many as they did. It
/// ends at the limit of measured runs that did not complete, if there are any. With
/// `implementation: fastdds` it has a schedule to sample; the paper's participants all start at 0,
/// unless an override gives them a schedule. Where starts are spread, programs take the usual time
/// (usual_hosts.hpp), unless an override says which.
[[nodiscard]] model::config::Result<model::Scenario> scenario_of(const Configuration& configuration,
                                                                 const ScenarioOptions& options);

/// In what the configuration differs from the scenario that should predict it ("loss 0.05", say);
/// empty if in nothing. The channel counts if asked for; what happens in it always has to be known
/// to the rules.
[[nodiscard]] std::string mismatch(const Configuration& configuration,
                                   const model::Scenario& scenario, bool by_channel = true);

}  // namespace stormproof::prediction
