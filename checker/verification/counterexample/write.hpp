// Counterexamples as files: a trace in the format of `simulate --trace` that stops at the event
// that breaks a property (specs/guide/trace-format.md, "Counterexamples"). `stormproof replay` runs
// it again, so nobody has to believe it.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "props/monitor.hpp"
#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// Runs the counterexample under the monitor of its property. Returns why it is not one: the
/// property has no monitor, or its monitor does not object at exactly that event.
[[nodiscard]] std::optional<std::string> refuted(const props::Counterexample& counterexample);

/// Writes the trace of the counterexample under the monitor of its property. Returns why it is not
/// one; then `out` has got nothing. Whether everything could be written is the stream's to say.
[[nodiscard]] std::optional<std::string> write_counterexample(
    const props::Counterexample& counterexample, std::ostream& out);
/// The same with a fresh monitor of the caller's.
[[nodiscard]] std::optional<std::string> write_counterexample(
    const props::Counterexample& counterexample, props::Monitor& monitor, std::ostream& out);

}  // namespace stormproof::counterexample
