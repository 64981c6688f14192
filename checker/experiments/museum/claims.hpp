// What exhibits of the museum of defects are held against: properties of runs of participants that
// forget, fall silent or come back, each with a formal statement and a monitor. Those of the
// catalogue (props/catalogue.cpp) are about writers that engines know; these are about runs, and
// hold or break under any rules.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "model/scenario.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::museum {

struct Claim {
  std::string_view id;
  std::string_view statement;
  std::string_view formal;
  bool has_bound = false;  ///< an exhibit says the bound B
};

[[nodiscard]] std::span<const Claim> claims();
/// Null if there is none.
[[nodiscard]] const Claim* find_claim(std::string_view id);

/// Objects to the first event that breaks its claim.
class ClaimMonitor : public props::Observer {
 public:
  using Observer::Observer;

  /// After the run: whether it was too short to say.
  [[nodiscard]] virtual bool is_undecided() const { return false; }
};

/// The monitor of one of the `claims` for runs of the scenario.
[[nodiscard]] std::unique_ptr<ClaimMonitor> monitor_of(std::string_view claim,
                                                       const model::Scenario& scenario,
                                                       std::optional<model::Nanoseconds> bound);

// One for each kind of claim; claims.cpp says which is whose.
[[nodiscard]] std::unique_ptr<ClaimMonitor> watch_recovery(std::string_view claim,
                                                           const model::Scenario& scenario,
                                                           model::Nanoseconds bound);
[[nodiscard]] std::unique_ptr<ClaimMonitor> watch_progress();
[[nodiscard]] std::unique_ptr<ClaimMonitor> watch_copies();
[[nodiscard]] std::unique_ptr<ClaimMonitor> watch_feedback();
[[nodiscard]] std::unique_ptr<ClaimMonitor> watch_joins();
[[nodiscard]] std::unique_ptr<ClaimMonitor> watch_piggybacks(const model::Scenario& scenario);
/// Acknowledged and not received; or, with `stable`, received and not acknowledged any more.
[[nodiscard]] std::unique_ptr<ClaimMonitor> watch_acknowledgments(bool stable);

}  // namespace stormproof::museum
