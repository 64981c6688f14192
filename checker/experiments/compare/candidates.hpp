// The ways to discover that users switch between, as scenarios beside the user's own: Fast DDS by
// multicast, with a Discovery Server on a robot or on a host of its own, with super clients, with
// static peers, with a larger send buffer, with one process on each host, and, where participants
// look up types (Fast DDS 3), with types that are not announced; Cyclone DDS by unicast,
// by multicast, and with the setting of it that helped most in live runs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "checker/experiments/compare/grown.hpp"
#include "checker/experiments/trials/launch_plan.hpp"
#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::compare {

/// What is done with the participants of the scenario.
enum class Placement : std::uint8_t { as_it_is, one_process_per_host, server_on_own_host };

struct Candidate {
  std::string id;        ///< "server-on-a-robot": in files and data
  std::string name;      ///< "server on a robot": in tables
  std::string change;    ///< what a user does for it, one sentence
  std::string profile;   ///< preset of it: "fastdds-server-2.6.11"
  std::string measured;  ///< which entry of what was measured live speaks of it; may be empty
  model::DdsProfile dds;
  model::WirelessProfile wireless;  ///< with this implementation
  Placement placement{};
  bool asks_every_port = false;      ///< static peers: as many ports as a host has participants
  std::optional<launch::Plan> plan;  ///< that its processes are started by; absent: the scenario's
  bool is_own = false;               ///< it is what the scenario says
  std::string note;                  ///< on what differs from what a user may expect; may be empty
  std::string skipped;               ///< why there are no runs of it; empty: there are
};

/// What the scenario is, and what it is compared with.
struct Candidates {
  model::Scenario scenario;  ///< the user's
  std::string preset;        ///< of its DDS profile: "fastdds-2.6.11"; may be empty
  std::vector<Candidate> list;
};

/// Reads the scenario, and each candidate with it: the version of the library is the scenario's
/// where there is a profile of it. Overrides of the DDS profile count for the scenario alone.
/// Errors are those of the scenario; what a candidate cannot be combined with is in `skipped`.
[[nodiscard]] model::config::Result<Candidates> candidates_of(
    const std::string& reference, std::span<const std::string> overrides,
    const model::config::SpecPath& specs);

/// A candidate at one size.
struct Instance {
  model::Scenario scenario;
  std::string refused;  ///< why it is no scenario; empty: it is one
};
[[nodiscard]] Instance instance_of(const Candidates& all, const Candidate& candidate, Grows what,
                                   std::uint32_t size);

}  // namespace stormproof::compare
