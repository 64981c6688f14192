// Random scenarios with the runs that judge them, made once and shared: hundreds of mutants of the
// product are compared with the same runs of the correct oracle, and all mistakes of an oracle with
// the same runs of the correct product.
#pragma once

#include <deque>
#include <functional>
#include <string_view>

#include "tests/oracle/comparison.hpp"

namespace stormproof::oracle {

/// Events that were taken from the queue. Those that were held, or had to wait for a thread, are
/// not among the events that happened.
[[nodiscard]] inline std::uint64_t processed(const Observed& observed) {
  for (const auto& [name, value] : observed.outcome) {
    if (std::string_view{name} == "events") return static_cast<std::uint64_t>(value);
  }
  return observed.events.size();
}

/// One scenario and the run of the correct side.
struct JudgedRun {
  model::Scenario scenario;
  Observed correct;
};

class JudgedRuns {
 public:
  /// Short runs only, so that a mutant that nothing notices costs little.
  static constexpr std::size_t most_events = 6'000;

  /// Runs the correct side, for a number of events at most.
  using Judge = std::function<Observed(const model::Scenario&, std::uint64_t)>;

  /// `draw` makes the scenario of a seed.
  JudgedRuns(std::function<model::Scenario(std::uint64_t)> draw, Judge judge)
      : draw_{std::move(draw)}, judge_{std::move(judge)} {}

  /// The k-th scenario whose run is short.
  const JudgedRun& at(std::size_t k) {
    while (runs_.size() <= k) {
      JudgedRun run{draw_(seed_++), {}};
      run.correct = judge_(run.scenario, most_events + 1);
      if (processed(run.correct) <= most_events) runs_.push_back(std::move(run));
    }
    return runs_[k];
  }

  /// How many scenarios it takes until `differs` says so; `tries` + 1 if none of `tries` does.
  std::size_t tries_until(std::size_t tries, const std::function<bool(const JudgedRun&)>& differs) {
    for (std::size_t k = 0; k < tries; ++k) {
      if (differs(at(k))) return k + 1;
    }
    return tries + 1;
  }

 private:
  std::function<model::Scenario(std::uint64_t)> draw_;
  Judge judge_;
  std::deque<JudgedRun> runs_;
  std::uint64_t seed_ = 0;
};

}  // namespace stormproof::oracle
