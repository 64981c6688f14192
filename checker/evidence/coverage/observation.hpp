// Measured discoveries, one JSON object per line: what `stormproof coverage` compares predictions
// with. The format is open to anyone's measurements; specs/observations/README.md lists its fields.
#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/coverage/change.hpp"
#include "checker/experiments/statistics/measure.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::prediction {

/// What is compared: the completion time (ms), all messages, and each class of messages; and of
/// runs in which something happened, what came of it.
using statistics::Measure;
inline constexpr std::size_t measure_count = statistics::measure_count;

/// When one participant announced itself and had all its endpoints, in ms since the common start.
struct Times {
  double start = 0;
  double endpoints_done = 0;
};

/// Starts that were meant to follow one another: `step_ms` after the process before, or after the
/// host before, whose processes start together.
struct Spread {
  double step_ms = 0;
  bool by_host = false;

  /// When a participant was to start, in ms.
  [[nodiscard]] double planned(std::uint32_t host, std::uint32_t participant) const {
    return step_ms * (by_host ? host : participant);
  }
  auto operator<=>(const Spread&) const = default;
};

/// What a row says of its network. A field that is absent says nothing.
struct Channel {
  std::optional<std::string> medium;          ///< "veth" and "wired": no shared channel
  std::optional<double> overhead_unicast_us;  ///< O_u_us
  std::optional<double> overhead_multicast_us;
  std::optional<double> rate_unicast_mbps;
  std::optional<double> rate_multicast_mbps;
  std::optional<double> loss;               ///< probability, of each frame
  std::optional<double> send_buffer_bytes;  ///< sndbuf_B; 0: the default of the system

  [[nodiscard]] bool wired() const { return medium == "veth" || medium == "wired"; }
  auto operator<=>(const Channel&) const = default;
};

/// One measured run.
struct Observation {
  std::string set;  ///< runs of different sets are never pooled; may be empty
  std::uint32_t hosts = 0;
  std::uint32_t participants_per_host = 0;
  std::uint32_t endpoints = 0;  ///< user endpoints per participant
  Channel channel;
  std::optional<std::uint32_t> peer_range;  ///< ports of each host, of static peers
  /// Endpoints say their types, and so many of each participant have one of their own.
  std::optional<std::uint32_t> unknown_types;
  bool looks_up_types = true;  ///< type_propagation is absent or `enabled`
  Spread spread;
  Change change;
  bool completed = true;
  /// By measure; of a run that did not complete these are lower bounds, the time limit for
  /// `completion`.
  std::array<std::optional<double>, measure_count> values;
  std::optional<Range> start;           ///< start_ms, or `enabled` of procs: first announcements
  std::optional<Range> create;          ///< create_ms: creation of the participant begins
  std::optional<Range> endpoints_done;  ///< ep_done_ms: all endpoints of a participant exist
  std::vector<Times> participants;      ///< of procs, host 0's first; empty unless all have both
  /// What each participant runs, in the same order; empty: all run the same.
  std::vector<std::string> profiles;
};

enum class CompletionTime : std::uint8_t { app, strict };

struct ReadOptions {
  CompletionTime completion = CompletionTime::app;
  std::vector<std::string> select;  ///< "KEY=VALUE"; a row must have all of them
};

struct Observations {
  std::vector<Observation> rows;
  std::size_t not_selected = 0;
};

/// Reads all lines; `name` places errors ("name:line"). Empty lines are skipped.
[[nodiscard]] model::config::Result<Observations> read_observations(std::istream& input,
                                                                    const std::string& name,
                                                                    const ReadOptions& options);

}  // namespace stormproof::prediction
