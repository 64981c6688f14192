// How much memory the program takes at most (`--max-memory`). Two lines of defence: somewhat below
// the limit the work is stopped as by Ctrl-C (run_monitor.hpp), and says what is known; beyond it
// the kernel refuses memory (RLIMIT_DATA), which ends the program with the same message. Either
// way the exit code is `inconclusive`. Programs that we start inherit the limit.
#pragma once

#include <cstdint>
#include <string>

#include "model/config/tree/result.hpp"

namespace stormproof::cli {

/// "500MB", "4GiB", "1.5 GB": bytes, at least 64 MiB. Empty: three quarters of what the machine or
/// the control group of the process has. The error names `--max-memory`.
[[nodiscard]] model::config::Result<std::uint64_t, std::string> memory_limit(
    const std::string& text);

/// Sets the limit, in bytes, for the whole process. Once, before threads are started.
void limit_memory(std::uint64_t bytes);
/// Sets the first line of defence alone: in a process that others share, the second is not ours.
void watch_memory(std::uint64_t bytes);

/// Whether the process is so close to its limit that it has to stop.
[[nodiscard]] bool memory_runs_short();

/// "needs more memory than 4.0 GB …": what to do about it.
[[nodiscard]] std::string needs_more_memory();

}  // namespace stormproof::cli
