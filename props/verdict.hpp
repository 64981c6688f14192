// What a check can answer. A verdict is never a bool: it says of what kind it is, how it was
// reached, and under which assumptions. A time-out, an unknown or a disagreement of two solvers is
// inconclusive; it is never "holds".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::props {

enum class VerdictKind : std::uint8_t {
  proved,       ///< for all cases that the assumptions admit
  bounded,      ///< for all cases up to a stated bound (one trajectory, a scope of the explorer)
  sampled,      ///< for the cases that were drawn
  violated,     ///< there is a counterexample
  inconclusive  ///< no answer: time-out, unknown, solvers disagree, outside the region of a theorem
};

[[nodiscard]] const char* name_of(VerdictKind kind);

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
  std::vector<std::string> details;  ///< invariants, matrices, witnesses, numbers; lines of text
  double seconds = 0;
  std::string solver;  ///< for example "z3 4.8.12 + cvc5 1.0.3"; empty if none was asked
  unsigned seed = 0;
  std::optional<Counterexample> counterexample;
  bool disputed =
      false;  ///< inconclusive because two solvers disagree: no other engine overrules it
};

}  // namespace stormproof::props
