// What the searches have found out about one claim, and the finding that follows from that: which
// scopes were exhausted, which were cut short and why, and what the explored world assumes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/search.hpp"
#include "props/verdict.hpp"

namespace stormproof::explorer {

/// Where the searches took place.
struct Surroundings {
  DelayBound delay;
  unsigned readers = 1;      ///< of one writer, at most
  unsigned writers = 1;      ///< of one participant, at most
  bool interrupted = false;  ///< somebody ended the searches
  std::vector<std::string> assumptions;
};

/// `running` is the scenario that runs.
[[nodiscard]] std::vector<std::string> assumptions_of(const model::Scenario& running,
                                                      const Surroundings& where);

class Answer {
 public:
  /// A search came to an end without an objection.
  void note_scope(const Scope& scope, Claim claim, const SearchResult& result,
                  const Bounds& bounds);
  /// A path breaks the claim, and so does the simulator's run of it.
  void note_counterexample(const Scope& scope, std::size_t events,
                           props::Counterexample counterexample);
  /// A path breaks the claim, and the simulator does not: one of them is wrong.
  void note_dispute(const Scope& scope, std::size_t events, const std::string& why_not);
  void note_effort(std::uint64_t states, double seconds);

  [[nodiscard]] props::Finding finding(Claim claim, const Surroundings& surroundings) const;

 private:
  [[nodiscard]] std::string what_was_explored(const Surroundings& surroundings) const;

  std::optional<props::Counterexample> counterexample_;
  std::string found_in_;   ///< scope of the counterexample
  std::string disputed_;   ///< why an objection does not count
  std::string exhausted_;  ///< these scopes, in short
  std::string cut_short_;  ///< and these, with how far the search came
  std::vector<std::string> details_;
  std::uint64_t states_ = 0;
  double seconds_ = 0;
};

}  // namespace stormproof::explorer
