// What kind of discovery a run was, in one word that an engineer acts on. A storm is told from a
// slow link by what feedback costs (storm.hpp): on a slow link everything is sent about once and
// that takes its time; in a storm needless repeats and control messages take the channel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/engines/exact/storm.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"

namespace stormproof::exact {

enum class Health : std::uint8_t {
  fine,
  slow_link,  ///< late, and the channel was busy: everything sent once already takes long
  waiting,  ///< late, and the channel was mostly idle: a timer had to expire, or a process started
  storm,    ///< `is_storm`: feedback decides
  incomplete  ///< not complete when the run ended, and no storm either
};
/// "fine", "slow_link", "waiting", "storm", "incomplete".
[[nodiscard]] const char* name_of(Health health);
/// "FINE", "SLOW LINK", "SLOW", "STORM", "INCOMPLETE".
[[nodiscard]] const char* headline_of(Health health);

struct RunHealth {
  Health health{};
  std::optional<model::Nanoseconds> completion;  ///< T_disc; absent: not complete
  /// When the last participant started or came back, or the last outage ended: what comes before
  /// is not waiting for discovery.
  model::Nanoseconds last_start;
  bool has_failures = false;  ///< some of the deployment's life, beside starts
  /// From then on to T_disc, or to the end of a run that is not complete; 0 if discovery was
  /// complete before.
  model::Nanoseconds took;
  double needless = 0;            ///< traffic until then, over everything sent once (storm.hpp)
  std::optional<double> airtime;  ///< used until then, over that of everything sent once
  std::optional<double> stretch;  ///< `took` over the airtime of the open loop
  double busy = 0;            ///< share of the time that the busiest channel was in use, 0 … 1
  std::uint64_t missing = 0;  ///< deliveries
};

[[nodiscard]] RunHealth health_of(const model::Scenario& scenario, const model::RunResult& result);

/// Several runs of one scenario, by their outcome: those that are complete first, by `took`.
class Outlook {
 public:
  /// At least one run.
  explicit Outlook(std::vector<RunHealth> runs);

  /// That of the middle one; of two, the worse.
  [[nodiscard]] const RunHealth& median() const { return runs_[runs_.size() / 2]; }
  [[nodiscard]] const RunHealth& best() const { return runs_.front(); }
  [[nodiscard]] const RunHealth& worst() const { return runs_.back(); }
  [[nodiscard]] std::size_t size() const { return runs_.size(); }
  [[nodiscard]] std::size_t count(Health health) const;
  [[nodiscard]] std::size_t completed() const;
  /// Storm if any run is one; otherwise that of the worst.
  [[nodiscard]] Health health() const;

  /// "STORM", "STORM in 11 of 12 runs".
  [[nodiscard]] std::string headline() const;
  /// What happens, without its headline, as a sentence without a full stop: "discovery completes
  /// 6.263 s after the last start; …".
  [[nodiscard]] std::string sentence() const;

 private:
  std::vector<RunHealth> runs_;
};

}  // namespace stormproof::exact
