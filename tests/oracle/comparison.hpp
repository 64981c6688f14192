// Holds the product against its oracle: runs both on a scenario and says where they part. One
// place, so that every test that compares them (fixed seeds, properties that shrink, mutants of the
// product, mistakes of the oracle) means the same by "equal": the same events in the same order,
// the same outcome, the same missing descriptors.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/mutation.hpp"
#include "model/scenario.hpp"
#include "tests/oracle/cyclone_oracle.hpp"
#include "tests/oracle/fastdds_oracle.hpp"
#include "tests/oracle/oracle.hpp"

namespace stormproof::oracle {

/// One processed event. Kind and insertion number are there to be printed and compared as far as
/// both sides mean the same by them.
struct ObservedEvent {
  std::int64_t time_ns = 0;
  int event_class = 0;
  std::uint64_t insertion = 0;
  const char* kind = "";
};

/// What a run showed, whoever made it.
struct Observed {
  std::vector<ObservedEvent> events;
  /// Completion time or −1, the counts, the number of missing descriptors; each with its name.
  std::vector<std::pair<const char*, std::int64_t>> outcome;
  std::vector<Missing> missing;  ///< the first `model::RunResult::missing_listed` of them
};

/// Runs the product, with a deliberate mistake if there is one, for at most `max_events` events (0:
/// no limit).
[[nodiscard]] Observed observe_product(const model::Scenario& scenario,
                                       const model::Mutation* mutation = nullptr,
                                       std::uint64_t max_events = 0);

/// Runs the oracle of the scenario's implementation, with a mistake if there is one.
[[nodiscard]] Observed observe_oracle(const model::Scenario& scenario,
                                      std::uint64_t max_events = 0);
[[nodiscard]] Observed observe_oracle(const model::Scenario& scenario, Mistake mistake,
                                      std::uint64_t max_events = 0);
[[nodiscard]] Observed observe_oracle(const model::Scenario& scenario, FastddsMistake mistake,
                                      std::uint64_t max_events = 0);
[[nodiscard]] Observed observe_oracle(const model::Scenario& scenario, WifiMistake mistake,
                                      std::uint64_t max_events = 0);
[[nodiscard]] Observed observe_oracle(const model::Scenario& scenario, ServerMistake mistake,
                                      std::uint64_t max_events = 0);
[[nodiscard]] Observed observe_oracle(const model::Scenario& scenario, CycloneMistake mistake,
                                      std::uint64_t max_events = 0);

/// Where the two runs part first, as a sentence, or nothing.
[[nodiscard]] std::optional<std::string> first_difference(const Observed& product,
                                                          const Observed& oracle);

/// How far a run is compared; few are longer.
inline constexpr std::uint64_t most_compared_events = 20'000;

/// Runs both, and also compares the open-loop airtime of a shared channel.
[[nodiscard]] std::optional<std::string> difference(const model::Scenario& scenario);

}  // namespace stormproof::oracle
