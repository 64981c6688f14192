// The same question as requests.hpp, decided by a solver: whether ACKNACKs can have arrived so that
// every transmission that needs a request has one. The greedy schedule is asked first, because it
// is fast and nearly always finds one; before a capture is said not to conform, this decides.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "checker/engines/smt/claims.hpp"
#include "checker/evidence/conform/requests.hpp"

namespace stormproof::conform {

struct ExactAnswer {
  enum class Kind : std::uint8_t { possible, impossible, unknown };
  Kind kind = Kind::unknown;
  std::vector<Arrival> arrivals{};  ///< `possible`: by answer; from and to are the same instant
  /// `possible`: for each demand the answer that serves it.
  std::vector<std::size_t> request{};
};

/// What ends the search without an answer.
struct SearchLimits {
  unsigned steps = smt::Budget{}.z3;    ///< units of Z3's `rlimit`, the same on every machine
  std::function<bool()> interrupted{};  ///< asked now and then, by another thread; may be empty
};

/// Whether all `demands` can be served. Each ACKNACK is lost or arrives in its window of `requests`
/// (which nobody has asked yet), in the order in which they were sent.
[[nodiscard]] ExactAnswer decide(const Relation& relation, const Requests& requests,
                                 const std::vector<Demand>& demands, const SearchLimits& limits);

}  // namespace stormproof::conform
