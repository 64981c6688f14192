// What `stormproof simulate` is asked for: one run, or the same sampled schedules under one or
// several DDS profiles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "model/scenario.hpp"

namespace stormproof::cli {

struct SimulateArguments {
  std::string scenario;                ///< file, or name of a shipped scenario
  std::vector<std::string> overrides;  ///< key.path=value
  OutputFile trace, perfetto, pcap;
  bool effects = false;                  ///< named in trace and timeline
  std::optional<std::uint64_t> samples;  ///< runs of sampled schedules instead of a single run
  std::optional<std::uint64_t> seed;     ///< of the first sample; not given: the schedule's
  std::vector<std::string> compare;      ///< DDS profiles to run on the same schedules
  std::string start_jitter;              ///< each participant starts up to this much later
};

/// `--samples N`, `--compare PROFILE` and `--start-jitter TIME`.
[[nodiscard]] Outcome sample(const SimulateArguments& arguments, const model::Scenario& scenario,
                             Session& session);

}  // namespace stormproof::cli
