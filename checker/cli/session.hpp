// What a command has while it runs: the line that repeats it, progress on stderr, and whether
// somebody wants it to stop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "checker/cli/given.hpp"
#include "checker/cli/run_monitor.hpp"
#include "checker/experiments/trials/budget.hpp"

namespace stormproof::model {
struct Progress;
}
namespace stormproof::report {
struct Document;
}

namespace stormproof::cli {

class Session {
 public:
  Session(std::vector<Given> given, bool shows_progress)
      : given_{std::move(given)}, line_{shows_progress} {}

  /// Gives the same answer again. `without`: options that are left out.
  [[nodiscard]] std::string command(std::initializer_list<std::string_view> without = {}) const {
    return shell_line(given_, without);
  }

  [[nodiscard]] static bool interrupted() { return InterruptGuard::interrupted(); }

  /// Of an answer that an interruption left incomplete: what it says is so far, whatever it is.
  static void note_interruption(report::Document& document);

  /// For `on_progress` of everything: shows what `text()` says if it is time for that; returns
  /// whether to go on.
  template <class MakeText>
  bool proceed(MakeText&& text) {
    if (line_.due()) line_.show(text());
    return !interrupted();
  }
  /// The same for many runs: how many are done, and about how long the rest takes.
  [[nodiscard]] std::function<bool(std::size_t done, std::size_t all)> on_runs();
  /// The same for steps that take a while: "WHAT, 12 s".
  [[nodiscard]] std::function<bool(std::string_view what)> on_steps(std::string doing = {});
  /// The same for a simulation.
  [[nodiscard]] std::function<bool(const model::Progress&)> on_simulation();
  /// The same for reading captures.
  [[nodiscard]] std::function<bool(std::uint64_t packets)> on_packets();

  /// The same for a study of many runs: "WHAT: 40 of about 440 runs, about 12 s left"; of a part
  /// that makes none, "WHAT, 12 s".
  [[nodiscard]] std::function<bool(std::string_view what, std::size_t done, std::size_t about)>
  on_study();

  [[nodiscard]] double seconds() const { return line_.seconds(); }
  /// Of `--time`.
  [[nodiscard]] static trials::Budget time() {
    return trials::Budget{InterruptGuard::seconds_left};
  }

 private:
  void estimate(double seconds, std::size_t done, std::size_t all);

  std::vector<Given> given_;
  StatusLine line_;
  bool has_estimated_ = false;
};

}  // namespace stormproof::cli
