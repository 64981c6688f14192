// How much of the transition tables a capture exercises: rows that fired, rows that never did, and
// of these the ones that cannot fire under the profile, with the knob that rules them out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/evidence/conform/conform.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

struct RowCoverage {
  const RowUse* use = nullptr;  ///< in Conformance::rows
  std::string ruled_out_by{};   ///< "sedp.heartbeat_policy: periodic"; empty: nothing does
};

struct MachineCoverage {
  std::string machine{};
  std::vector<RowCoverage> rows{};
  std::uint64_t used = 0;
  std::uint64_t ruled_out = 0;  ///< of those that were not used
};

/// By machine, in the order of `rows`; `rows` has to live as long as the answer.
[[nodiscard]] std::vector<MachineCoverage> coverage_of(const std::vector<RowUse>& rows,
                                                       const model::DdsProfile& dds);

/// Why each row of the machine cannot fire under the profile, in table order; empty: it can, as far
/// as guards on knobs and the states behind them tell. Nothing for a machine that is not known.
[[nodiscard]] std::vector<std::string> ruled_out(std::string_view machine,
                                                 const model::DdsProfile& dds);

}  // namespace stormproof::conform
