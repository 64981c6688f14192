// The machine's memory, the kernel's limit, and what happens when a thread gets none.
#include "checker/cli/memory_limit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include "checker/cli/exit_code.hpp"
#include "checker/cli/output_file.hpp"

namespace stormproof::cli {

namespace {

using Bytes = std::uint64_t;

constexpr Bytes least_limit = Bytes{64} << 20U;

/// Sanitizers keep much more memory than the program asked for, and reserve more still.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
constexpr bool is_sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool is_sanitized = false;
#endif

Bytes limit_bytes = 0;
std::array<char, 256> last_words{};  // ready for when there is no memory to make them

/// The number at the start of a file such as memory.max; nothing if there is none ("max").
std::optional<Bytes> number_in(const std::string& path) {
  std::ifstream file{path};
  Bytes number = 0;
  if (!(file >> number)) return std::nullopt;
  return number;
}

/// The least limit of the control groups above this process (version 2), or of version 1.
std::optional<Bytes> control_group_limit() {
  std::optional<Bytes> least;
  const auto consider = [&](const std::string& file) {
    const auto limit = number_in(file);
    if (limit && (!least || *limit < *least)) least = limit;
  };
  std::ifstream groups{"/proc/self/cgroup"};
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    for (std::string group = line.substr(3); !group.empty();) {
      consider("/sys/fs/cgroup" + group + "/memory.max");
      group.erase(group.find_last_of('/'));
    }
  }
  consider("/sys/fs/cgroup/memory.max");
  consider("/sys/fs/cgroup/memory/memory.limit_in_bytes");
  return least;
}

Bytes usual_limit() {
  const auto pages = static_cast<Bytes>(std::max(0L, sysconf(_SC_PHYS_PAGES)));
  Bytes memory = pages * static_cast<Bytes>(sysconf(_SC_PAGESIZE));
  if (const auto group = control_group_limit()) memory = std::min(memory, *group);
  return std::max(least_limit, memory / 4 * 3);
}

constexpr std::array<std::pair<std::string_view, double>, 8> units{{{"B", 1},
                                                                    {"kB", 1e3},
                                                                    {"MB", 1e6},
                                                                    {"GB", 1e9},
                                                                    {"TB", 1e12},
                                                                    {"MiB", 1 << 20},
                                                                    {"GiB", 1 << 30},
                                                                    {"TiB", 1099511627776.0}}};

std::optional<Bytes> parsed(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number) || number < 0) return std::nullopt;
  std::string_view unit{end, static_cast<std::size_t>(text.data() + text.size() - end)};
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [name, factor] : units) {
    const double bytes = number * factor;
    if (unit == name && bytes < 1e18) return static_cast<Bytes>(bytes);
  }
  return std::nullopt;
}

std::string size_text(Bytes bytes) {
  return bytes >= 1'000'000'000 ? fmt::format("{:.1f} GB", static_cast<double>(bytes) / 1e9)
                                : fmt::format("{:.0f} MB", static_cast<double>(bytes) / 1e6);
}

/// An exception that nobody caught: a thread got no memory, or a broken invariant.
[[noreturn]] void end_process() {
  bool memory = false;
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    memory = true;
  } catch (...) {
  }
  OutputFile::discard_all();
  if (!memory) std::abort();
  (void)!write(STDERR_FILENO, last_words.data(), std::strlen(last_words.data()));
  _exit(inconclusive);
}

}  // namespace

model::config::Result<Bytes, std::string> memory_limit(const std::string& text) {
  if (text.empty()) return usual_limit();
  const auto bytes = parsed(text);
  if (bytes && *bytes >= least_limit) return *bytes;
  return fmt::format("--max-memory '{}': expected a size of at least 64MiB, such as 500MB or 4GiB",
                     text);
}

void watch_memory(Bytes bytes) { limit_bytes = bytes; }

void limit_memory(Bytes bytes) {
  watch_memory(bytes);
  const std::string words = "stormproof: " + needs_more_memory() + "\n";
  std::copy_n(words.begin(), std::min(words.size(), last_words.size() - 1), last_words.begin());
  std::set_terminate(end_process);
  if (is_sanitized) return;
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, bytes);
  (void)setrlimit(RLIMIT_DATA, &limit);
}

bool memory_runs_short() {
  static const auto page = static_cast<Bytes>(sysconf(_SC_PAGESIZE));
  Bytes all = 0;
  Bytes resident = 0;
  std::ifstream{"/proc/self/statm"} >> all >> resident;
  return limit_bytes > 0 && resident * page > limit_bytes / 8 * 7;
}

std::string needs_more_memory() {
  return fmt::format(
      "needs more memory than {}; reduce the deployment, shorten its limits or raise --max-memory",
      size_text(limit_bytes));
}

}  // namespace stormproof::cli
