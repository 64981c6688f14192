// The results of a grid as files, in its order, without anything that differs from one run of the
// same sweep to the next: an evaluation that is repeated or resumed gives the same bytes.
#pragma once

#include <ostream>

#include "checker/experiments/sweep/collector.hpp"

namespace stormproof::sweep {

/// One line a job: the swept keys, end, the numbers of `number_names`, digest, error. A job that is
/// not done has the end "interrupted" and no numbers.
void write_csv(std::ostream& out, const Plan& plan, const Collector& results);

/// An object with grid, version, keys, jobs, completed and runs; times in ns.
void write_json(std::ostream& out, const Plan& plan, const Collector& results,
                const std::string& program_version);

}  // namespace stormproof::sweep
