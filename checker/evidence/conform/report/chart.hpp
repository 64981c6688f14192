// The context of an unexplained event as a sequence chart: the participant that sends on the left,
// and the captured datagrams with what the assignment does to them, numbered as tshark does.
#pragma once

#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/sequence/chart.hpp"

namespace stormproof::conform {

[[nodiscard]] sequence::Chart chart_of(const Report& report, const Unexplained& unexplained);

}  // namespace stormproof::conform
