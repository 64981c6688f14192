// Why effects cannot happen: because of one knob of the profile, whatever the others say, because
// of several together, or whatever the knobs. Each answer is a set of variables that keep their
// initial values, checked again by both solvers: no step changes any of them.
#pragma once

#include "checker/engines/tables/effect_system.hpp"
#include "checker/engines/tables/proof.hpp"

namespace stormproof::tables {

struct RuledOut {
  std::string by;  ///< "dds.sedp.heartbeat_policy: periodic"; empty: whatever the knobs
  std::vector<std::size_t> effects;
};

/// Of `impossible`, by effect, what is known. Each effect is in at most one group.
[[nodiscard]] std::vector<RuledOut> why_ruled_out(Proof& proof, const EffectSystem& effects,
                                                  std::vector<bool> impossible);

}  // namespace stormproof::tables
