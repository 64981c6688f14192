// What every format says about a result as a whole: the verdict in one line and in words, where it
// stops, and faults put together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/evidence/conform/report/report.hpp"

namespace stormproof::conform {

/// "DOES NOT CONFORM to fastdds-2.9.1 within these bounds: …".
[[nodiscard]] std::string verdict_line(const Report& report);
/// What the verdict means, and what it does not mean: sentences on one line.
[[nodiscard]] std::string verdict_meaning(const Report& report);
/// "conforms", "does_not_conform", "inconclusive".
[[nodiscard]] std::string verdict_token(Verdict verdict);

/// "a.pcap and b.pcap".
[[nodiscard]] std::string captures_text(const Report& report);

/// Places whose first unexplained event has the same fault.
struct FaultGroup {
  Fault fault{};
  std::uint64_t places = 0;
  const Unexplained* first = nullptr;
};
/// In the order of the first of each.
[[nodiscard]] std::vector<FaultGroup> by_fault(const Conformance& result);

/// Rules that explain at least one event.
[[nodiscard]] std::size_t rules_used(const Conformance& result);

}  // namespace stormproof::conform
