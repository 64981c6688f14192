// What a check can answer. A verdict is never a bool: it says of what kind it is, how it was
// reached, and under which assumptions. A search that was cut short or an unknown is inconclusive;
// two answers that contradict each other make a dispute. Neither is ever "holds".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::props {

/// The kinds that establish something come first, the strongest of them before all.
enum class VerdictKind : std::uint8_t {
  proved,        ///< for all cases that the assumptions admit
  bounded,       ///< for all cases of a stated scope, which was exhausted
  sampled,       ///< for the runs that were drawn
  observed,      ///< on the one trajectory of this scenario
  violated,      ///< there is a counterexample
  inconclusive,  ///< no answer: search cut short, unknown, outside the region of a theorem
  disputed       ///< two engines, two solvers, or engine and simulator contradict each other
};
/// In the order in which reports show them: what overrules the others first.
inline constexpr std::array verdict_kinds{
    VerdictKind::disputed, VerdictKind::violated, VerdictKind::inconclusive, VerdictKind::proved,
    VerdictKind::bounded,  VerdictKind::sampled,  VerdictKind::observed};

[[nodiscard]] const char* name_of(VerdictKind kind);
/// Whether something is established.
[[nodiscard]] constexpr bool holds(VerdictKind kind) { return kind <= VerdictKind::observed; }

/// A run that breaks a property: a scenario whose run the property's monitor objects to. It is
/// written as a trace and replays through the MSM machines.
struct Counterexample {
  std::string property;            ///< id
  model::Scenario scenario;        ///< reaches the violation
  std::uint64_t event = 0;         ///< number of the event at which the monitor objects, from 0
  model::Nanoseconds time;         ///< of that event
  std::string reason;              ///< one sentence: why the property breaks there
  std::vector<std::string> steps;  ///< optional: the story in the engine's own words
};

/// The answer of one engine about one property.
struct Finding {
  VerdictKind kind = VerdictKind::inconclusive;
  std::string engine;  ///< "tables", "explorer", "timelines", …: `name_of(Engine)`
  std::string how;     ///< method and bounds, one sentence
  std::vector<std::string> assumptions;  ///< one sentence each
  /// It is established if no packet takes longer; absent: whatever packets take.
  std::optional<model::Nanoseconds> longest_delay;
  std::vector<std::string> details;  ///< invariants, matrices, witnesses, numbers; lines of text
  double seconds = 0;
  std::string solver;  ///< for example "z3 4.8.12 + cvc5 1.0.3"; empty if none was asked
  unsigned seed = 0;
  std::optional<Counterexample> counterexample;
};

/// Something contradicts what the finding says: it is disputed, whatever it was.
void dispute(Finding& finding, const std::string& why);

}  // namespace stormproof::props
