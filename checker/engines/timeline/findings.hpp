// The verdicts of this engine: each theorem, applied to a scenario.
#pragma once

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/bounds/measure.hpp"
#include "checker/engines/bounds/resting.hpp"
#include "model/implementations.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::timeline {

using checker::leave_open;
using checker::rest_on;

/// The question and what the scenario's own run measures.
struct Question {
  const checker::CheckRequest& request;
  const exact::Measured& measured;

  [[nodiscard]] const model::DdsProfile& dds() const { return request.scenario.dds; }
  [[nodiscard]] const model::SedpProfile& sedp() const { return request.scenario.dds.sedp; }
  /// Which writer a theorem has to be about.
  [[nodiscard]] model::Writer writer() const { return model::traits_of(dds()).writer; }
  [[nodiscard]] bool is_adaptive() const {
    return sedp().heartbeat_policy == model::HeartbeatPolicy::adaptive;
  }
  /// Every packet takes the same time.
  [[nodiscard]] bool has_constant_delay() const {
    return props::takes_equal_times(request.scenario.wireless);
  }
};

[[nodiscard]] props::Finding completion_finding(const Question& question);
[[nodiscard]] props::Finding quiescence_finding(const Question& question);
[[nodiscard]] props::Finding single_copy_finding(const Question& question);
[[nodiscard]] props::Finding free_threshold_finding(const Question& question);

/// A run of the machines does what was proved to be impossible: a dispute between this engine and
/// the simulator; a mutant has been noticed.
void run_contradicts(props::Finding& finding, const checker::CheckRequest& request,
                     const std::string& why);

/// What the run of the scenario says about "no packet takes longer than Δ" and "nothing is lost".
[[nodiscard]] std::string measured_text(const exact::Measured& measured);

}  // namespace stormproof::timeline
