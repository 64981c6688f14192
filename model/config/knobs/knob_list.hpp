// All knobs of a scenario as a flat list, for documentation, for fuzzing, and for whoever wants to
// try every value of every knob.
#pragma once

#include <string>
#include <vector>

#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/value_json.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::model::config {

struct KnobInfo {
  std::string
      key;  ///< as `--set` takes it: "dds.sedp.heartbeat_period"; "*" for an element of a list
  TypeInfo type;       ///< kind, range or choices
  Json default_value;  ///< the value of the paper's evaluation, in the syntax of the file; null if
                       ///< absent
  std::string doc;     ///< one line
  Presence presence;   ///< whether a file without `base:` has to give it, or may not
};

/// Every knob of deployment (both forms), DDS profile, wireless profile and scenario. Whatever the
/// implementation, the keys are the same; those that only the paper's model has are then marked
/// `of_paper`.
[[nodiscard]] std::vector<KnobInfo> scenario_knob_list(
    ImplementationKind implementation = ImplementationKind::paper);

}  // namespace stormproof::model::config
