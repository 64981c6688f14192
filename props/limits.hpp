// The limits of a scenario (`limits:` and its `time_limit`) as properties of a run: each has an id,
// a statement and a monitor, so that a run that exceeds one is a counterexample like any other and
// replays. They are no part of the catalogue, because they hold or not by the author's choice.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/scenario.hpp"
#include "props/monitor.hpp"
#include "props/property.hpp"

namespace stormproof::props {

/// "limit.completion", "limit.messages", "limit.amplification", "limit.backlog", "limit.time".
[[nodiscard]] std::span<const Property> limit_properties();

/// Ids of those of `limits:` that are set, in this order.
[[nodiscard]] std::vector<std::string_view> set_limits(const std::optional<model::Limits>& limits);
/// What a deployment is held against: those that are set, and limit.time, because a discovery that
/// does not complete within the scenario's time_limit has failed.
[[nodiscard]] std::vector<std::string_view> limits_of(const model::Scenario& scenario);

/// How far a run went with respect to one limit. Units: ns, messages, a ratio, packets.
struct LimitReading {
  std::string_view id;
  double limit = 0;
  std::optional<double> reached;  ///< absent: discovery was not complete when the run ended
  bool exceeded = false;
};

/// Observes all of `limits:` that are set. Limits are about discovery: what follows its
/// completion does not count.
class LimitWatch {
 public:
  explicit LimitWatch(const model::Scenario& scenario);
  ~LimitWatch();
  LimitWatch(const LimitWatch&) = delete;
  LimitWatch& operator=(const LimitWatch&) = delete;

  /// What has to observe the run, once for each limit.
  [[nodiscard]] std::vector<model::Probe*> probes();
  /// After the run; `end` is the time up to which it is known.
  [[nodiscard]] std::vector<LimitReading> finish(model::Nanoseconds end);

 private:
  class Monitors;
  std::unique_ptr<Monitors> monitors_;
};

}  // namespace stormproof::props
