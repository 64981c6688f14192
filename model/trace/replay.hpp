// Replays a trace: runs the scenario in its header again and compares every line with the recorded
// one. A trace that replays is evidence: nothing in it was invented, cut out or made with another
// version of the rules.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "model/config/result.hpp"
#include "model/config/spec_path.hpp"
#include "model/simulator.hpp"
#include "model/trace/trace_json.hpp"

namespace stormproof::model::trace {

enum class Verdict : std::uint8_t {
  identical,   ///< every line of the trace happens again, up to its last line
  different,   ///< a line does not; `Replay::difference` shows it
  ends_early,  ///< every line agrees, but the recorded run or its trace was interrupted
  stopped      ///< every line so far agrees, then the caller stopped the replay
};

[[nodiscard]] const char* name_of(Verdict verdict);

/// The first line that differs.
struct Difference {
  std::uint64_t line = 0;     ///< in the trace, from 1
  Mismatch mismatch;          ///< its first key that differs
  std::string recorded_line;  ///< cut after 1,000 bytes
  std::string replayed_line;  ///< the same
};

struct Replay {
  Verdict verdict = Verdict::identical;
  std::uint64_t lines = 0;   ///< lines that agree, the header included
  std::uint64_t events = 0;  ///< events that agree
  std::string recorded_by;   ///< the program named in the header
  Nanoseconds last_time;     ///< of the last event that agrees
  std::optional<Nanoseconds>
      discovery_time;  ///< T_disc; only of an identical trace of a complete run
  std::optional<Difference> difference;
};

/// Errors: the file cannot be read, is not a trace, has an unknown version, or has a line that is
/// not JSON, too long or cut off. `on_progress` is the one of `RunOptions`.
[[nodiscard]] config::Result<Replay> replay(
    const std::string& file, const config::SpecPath& specs,
    const std::function<bool(const Progress&)>& on_progress = {});

}  // namespace stormproof::model::trace
