// What one run of the live bed was, and what was counted in it: read from the files in its folder,
// run.json and participants/*.json (written by the bed) and summary.json (`capture summarize`).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stormproof::live {

/// What one participant reported. Instants are ns since 1970; 0: not reached (in time).
struct ParticipantReport {
  std::int64_t created_ns = 0;
  std::int64_t endpoints_done_ns = 0;
  std::int64_t app_ns = 0;     ///< all its matched counters reached
  std::int64_t strict_ns = 0;  ///< every endpoint of other hosts discovered
  std::int64_t matches = 0;
  std::int64_t matches_expected = 0;
  std::int64_t discovered = 0;
  std::int64_t discovered_expected = 0;

  [[nodiscard]] bool is_complete() const { return app_ns != 0 && strict_ns != 0; }
};

/// Packets of one host.
struct CaptureReport {
  std::int64_t packets = 0;
  std::int64_t dropped = 0;            ///< by the capture
  std::int64_t interface_dropped = 0;  ///< by the interface, before the link
  std::int64_t socket_dropped = 0;     ///< that arrived and found their socket's buffer full
};

struct Counts {
  std::int64_t spdp = 0;
  std::int64_t initial_data = 0;
  std::int64_t repair_data = 0;
  std::int64_t heartbeat = 0;
  std::int64_t acknack = 0;
  std::int64_t total = 0;
};

struct CapturedParticipant {
  std::int64_t publications = 0;
  std::int64_t subscriptions = 0;
};

struct RunRecord {
  std::string name{};  ///< of its folder
  std::string link{};
  std::string discovery = "simple";  ///< or "static", "server", "super_client"
  bool sedp_multicast = false;       ///< then a DATA may be for several, and F says nothing
  std::int64_t hosts = 2;            ///< N_H
  std::int64_t participants_per_host = 0;
  std::int64_t endpoints_per_participant = 0;  ///< of the user
  std::int64_t start_ns = 0;
  std::int64_t limit_ns = 0;   ///< after the start; what was reached later was not reached
  std::int64_t waited_ns = 0;  ///< until complete, or given up
  std::vector<CaptureReport> captures{};          ///< one for each host
  std::vector<ParticipantReport> participants{};  ///< that reported
  Counts counts{};
  std::int64_t required_keys = 0;
  std::int64_t missing_keys = 0;
  std::vector<CapturedParticipant> captured{};
  std::string conformance{};  ///< the verdict of `conform`; empty: not asked

  [[nodiscard]] bool has_server() const {
    return discovery == "server" || discovery == "super_client";
  }
  /// F = N_H·(N_H−1)·N_P²·(17+N_E): descriptors times their destinations on other hosts. With a
  /// server on host 0: those of the other hosts to it, and from it what each participant there is
  /// told of all others.
  [[nodiscard]] std::int64_t expected_initial() const;
  [[nodiscard]] bool is_complete() const;
  /// Time from the start to the last participant's completion, ns. The run must be complete.
  [[nodiscard]] std::int64_t app_duration_ns() const;
  [[nodiscard]] std::int64_t strict_duration_ns() const;
};

/// Throws std::runtime_error that names the file and what is wrong with it.
[[nodiscard]] RunRecord read_run(const std::filesystem::path& folder);

}  // namespace stormproof::live
