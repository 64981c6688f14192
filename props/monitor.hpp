// Monitors: observers of a run that know one property and object to the first event that breaks it.
// They decide the property on the trajectory of a fixed scenario, they confirm the counterexamples
// of the other engines, and `replay` uses them to say whether a recorded violation occurs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/probe.hpp"
#include "model/scenario.hpp"

namespace stormproof::props {

/// The first event that breaks a property.
struct Violation {
  std::uint64_t event = 0;  ///< number of the event, from 0
  model::Nanoseconds time;
  std::string reason;  ///< one sentence with the participants, stream, descriptor and times
};

class Monitor : public model::Probe {
 public:
  /// Id of the property.
  [[nodiscard]] virtual std::string_view property() const = 0;
  /// To be called after the run; `end` is the time up to which the run is known.
  virtual void finish(model::Nanoseconds /*end*/) {}

  [[nodiscard]] const std::optional<Violation>& violation() const { return violation_; }
  /// After the run: whether it was too short to say.
  [[nodiscard]] virtual bool is_undecided() const { return false; }
  /// What the monitor takes from the run instead of judging it; one sentence each.
  [[nodiscard]] virtual std::vector<std::string> assumptions() const { return {}; }
  /// Lines worth reporting if nothing broke: largest delay, margins, counts.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }

 protected:
  /// Only the first objection counts.
  void object(std::uint64_t event, model::Nanoseconds time, std::string reason) {
    if (!violation_) violation_ = Violation{event, time, std::move(reason)};
  }

 private:
  std::optional<Violation> violation_;
};

/// The monitor of a property for runs of `scenario`, or null if the property cannot be decided by
/// observation. `scenario` is the specification that the run is held against (its W, τ_S, …).
[[nodiscard]] std::unique_ptr<Monitor> make_monitor(std::string_view property,
                                                    const model::Scenario& scenario);

/// Ids of all properties that have a monitor.
[[nodiscard]] std::vector<std::string_view> monitored_properties();
/// Those of them that apply to the scenario (props/applicability.hpp).
[[nodiscard]] std::vector<std::string_view> monitored_properties(const model::Scenario& scenario);

}  // namespace stormproof::props
