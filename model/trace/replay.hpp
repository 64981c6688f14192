// Replays a trace: runs the scenario in its header again and compares every line with the recorded
// one. A trace that replays is evidence: nothing in it was invented, cut out or made with another
// version of the rules.
//
// A trace whose header has `expect` is a counterexample: it stops at the event that breaks a
// property, and its last line says why. Its replay also asks a monitor of that property, which the
// caller supplies, whether the violation occurs there.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"
#include "model/simulator.hpp"
#include "model/trace/trace_json.hpp"

namespace stormproof::model::trace {

enum class Verdict : std::uint8_t {
  identical,    ///< every line of the trace happens again, up to its last line
  different,    ///< a line does not; `Replay::difference` shows it
  ends_early,   ///< every line agrees, but the recorded run or its trace was interrupted
  stopped,      ///< every line so far agrees, then the caller stopped the replay
  violated,     ///< every line of a counterexample agrees, and its violation occurs
  not_violated  ///< its events agree, but the violation does not occur, or not at that event
};

[[nodiscard]] const char* name_of(Verdict verdict);

/// The first line that differs.
struct Difference {
  std::uint64_t line = 0;     ///< in the trace, from 1
  Mismatch mismatch;          ///< its first key that differs
  std::string recorded_line;  ///< cut after 1,000 bytes
  std::string replayed_line;  ///< the same
};

/// What `expect` in a header announces, and what a monitor objects to.
struct TraceViolation {
  std::string property;     ///< id
  std::uint64_t event = 0;  ///< number of the event, from 0
  Nanoseconds time;         ///< of that event
  std::string reason;       ///< one sentence; another program may word it otherwise
};

/// "property":ID,"event":N,"t":NS,"reason":TEXT as an object.
[[nodiscard]] Json to_json(const TraceViolation& violation);

/// Watches a replay for a violation of one property.
class ViolationWatch {
 public:
  virtual ~ViolationWatch() = default;

  /// What observes the run.
  [[nodiscard]] virtual Probe& probe() = 0;
  /// The run is over; it is known up to `end`.
  virtual void finish(Nanoseconds end) = 0;
  /// The first violation so far.
  [[nodiscard]] virtual std::optional<TraceViolation> violation() const = 0;
};

/// Makes the watch for a property in runs of a scenario; null if there is none for it.
using WatchMaker =
    std::function<std::unique_ptr<ViolationWatch>(const std::string& property, const Scenario&)>;

/// Up to when a run is known: its time limit, unless it ended before because it was complete or
/// interrupted.
[[nodiscard]] Nanoseconds known_until(const RunResult& result, const Scenario& scenario);

struct Replay {
  Verdict verdict = Verdict::identical;
  std::uint64_t lines = 0;   ///< lines that agree, the header included
  std::uint64_t events = 0;  ///< events that agree
  std::string recorded_by;   ///< the program named in the header
  Nanoseconds last_time;     ///< of the last event that agrees
  std::optional<Nanoseconds>
      discovery_time;  ///< T_disc; only of an identical trace of a complete run
  std::optional<Difference> difference;
  std::optional<TraceViolation> expected;   ///< only of a counterexample
  std::optional<TraceViolation> violation;  ///< what the monitor objected to, if anything
};

/// Errors: the file cannot be read, is not a trace, has an unknown version, has a line that is not
/// JSON, too long or cut off, or expects a violation that `watch_for` knows nothing about.
/// `on_progress` is the one of `RunOptions`.
[[nodiscard]] config::Result<Replay> replay(
    const std::string& file, const config::SpecPath& specs,
    const std::function<bool(const Progress&)>& on_progress = {}, const WatchMaker& watch_for = {});

}  // namespace stormproof::model::trace
