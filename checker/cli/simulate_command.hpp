// `stormproof simulate SCENARIO`: runs one scenario and prints its predicted discovery.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stormproof::cli {

struct SimulateArguments {
  std::string scenario;                ///< file, or name of a shipped scenario
  std::vector<std::string> overrides;  ///< key.path=value
  bool json = false;
  std::optional<std::size_t> samples;  ///< runs of sampled schedules instead of a single run
  std::optional<std::uint64_t> seed;   ///< of the first sample; not given: the schedule's
  std::vector<std::string> compare;    ///< DDS profiles to run on the same schedules
  std::string trace_file;              ///< empty: none
  std::string perfetto_file;           ///< empty: none
  std::string pcap_file;               ///< empty: none
  std::optional<bool> progress;        ///< not given: when stderr is a terminal
};

/// Exit code: violated if a limit of the scenario is exceeded (not with samples), established if
/// discovery completes (with samples: in every run of the scenario's own profile), inconclusive if
/// not within the time limit or interrupted, bad_input.
[[nodiscard]] int simulate(const SimulateArguments& arguments);

}  // namespace stormproof::cli
