// The gain of a deployment: the most needless repairs that one repair can cause, through the
// HEARTBEATs that its bytes add to, and the ACKNACKs that answer these. Below 1 the repairs of a
// run are a geometric series, whatever the delays are: a storm burns out. It needs no bound on
// delays. specs/guide/cannot-start.md, "The gain".
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/engines/calculus/recurrence.hpp"
#include "model/scenario.hpp"

namespace stormproof::timeline {
class Theorem;  // checker/engines/timeline/theorem.hpp
}

namespace stormproof::calculus {

/// Of one writer: `bytes · readers · descriptors` against `budget`.
struct WriterGain {
  std::int64_t descriptors = 0;  ///< that one ACKNACK can ask for
  std::int64_t readers = 0;      ///< that a piggyback HEARTBEAT goes to
  std::int64_t bytes = 0;        ///< that a repaired descriptor is charged with, at most
  std::int64_t budget = 1;       ///< threshold + 1: what an exhaustion takes, at least
  std::int64_t pushed = 0;       ///< bytes that are charged for what is sent first

  [[nodiscard]] double value() const;
  [[nodiscard]] bool is_below_one() const { return loop() < budget; }
  /// All repairs of the writer, if `heartbeats` reach its readers that no piggybacking causes;
  /// nothing if the gain is 1 or more.
  [[nodiscard]] std::optional<std::int64_t> repairs(std::int64_t heartbeats) const;

 private:
  [[nodiscard]] std::int64_t loop() const { return times(times(bytes, readers), descriptors); }
};

struct Gain {
  WriterGain worst;  ///< of all writers
  /// Repairs of all writers from the start to `until`, without a loss; nothing if some gain is 1 or
  /// more.
  [[nodiscard]] std::optional<std::int64_t> repairs(model::Nanoseconds until) const;
  /// HEARTBEATs and initial ACKNACKs of a reader up to then that no piggybacking causes.
  [[nodiscard]] std::int64_t asked(model::Nanoseconds until) const;

  std::vector<WriterGain> writers;
  Recurrence periodic;
  std::optional<Recurrence> attempts;  ///< initial ACKNACKs of a reader, if there are any
};

/// Nothing for the adaptive policy and for additive timers, whose HEARTBEATs have no rate.
[[nodiscard]] std::optional<Gain> gain_of(const model::Scenario& scenario);

/// The geometric series of one writer, up to a time.
void prove_gain(timeline::Theorem& theorem, const WriterGain& gain, std::int64_t heartbeats);

}  // namespace stormproof::calculus
