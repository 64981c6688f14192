// The table of a tuning: the unchanged setting, what the search found, and fixed settings to
// compare with, all under the same seeds.
#pragma once

#include "checker/experiments/tune/tune.hpp"

namespace stormproof::tune {

/// The rows without their numbers. `choice` is the setting to recommend; it may be the unchanged
/// one, or one of `front`. The comparisons are: a send buffer of 4 MB alone (Fast DDS), which is
/// what experience recommends; the paper's adaptive HEARTBEATs, which no user can set; and, where
/// the channel model has a queue of the size of the send buffer, the choice with that queue grown.
[[nodiscard]] std::vector<Row> rows_of(const Subject& subject, const Space& space,
                                       const std::vector<Point>& front, const Point& choice);

/// Puts the rows with their numbers into the report. Settings of the front that break something, or
/// that another one dominates, are left out, and the answer follows. `outcomes` are those of each
/// row under `report.compared`.
void judge_rows(std::vector<Row> rows, const std::vector<std::vector<Outcome>>& outcomes,
                const Options& options, Report& report);

/// The same if the study was interrupted: what is known of the rows, by point.
void describe_interrupted(std::vector<Row> rows, const std::map<Point, std::vector<Outcome>>& known,
                          Report& report);

}  // namespace stormproof::tune
