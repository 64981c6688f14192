// What monitors of live.recovery have in common, whatever is to be complete again: when something
// failed last, how long is enough from then on, and when it is judged.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "model/life.hpp"
#include "props/monitors/delay_observer.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/recovery_bound.hpp"

namespace stormproof::props {

class RecoveryObserver : public DelayObserver {
 public:
  /// `bound` in place of that of the rules.
  RecoveryObserver(const model::Scenario& scenario, std::optional<model::Nanoseconds> bound)
      : DelayObserver{"live.recovery", scenario},
        scenario_{scenario},
        given_bound_{bound},
        failed_{last_failure(scenario.deployment)} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (event.time > failed_ && event.time > due(event.time)) judge(event.time);
  }
  void arrived(const model::Packet& packet, bool lost) override {
    DelayObserver::arrived(packet, lost);
    if (lost) failed_ = std::max(failed_, now());
  }
  void finish(model::Nanoseconds end) override {
    end_ = end;
    undecided_ = end < due(end) && is_missing_something();
    if (!undecided_) judge(end);
  }
  [[nodiscard]] bool is_undecided() const override { return undecided_; }
  [[nodiscard]] std::vector<std::string> assumptions() const override {
    return {fmt::format("no packet takes longer than Δ (in this run the largest delay is {})",
                        time_text(delays().largest(end_)))};
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {
        fmt::format("Nothing fails after {}; B = {}.", time_text(failed_), time_text(bound(end_)))};
  }

 protected:
  /// When something failed last, so far.
  [[nodiscard]] model::Nanoseconds failed() const { return failed_; }
  [[nodiscard]] virtual bool is_missing_something() const = 0;
  /// Something is missing, and nothing should be since `due`.
  virtual void complain(model::Nanoseconds due) = 0;

 private:
  /// B; of packets under way at that time their age counts.
  [[nodiscard]] model::Nanoseconds bound(model::Nanoseconds time) const {
    return given_bound_ ? *given_bound_
                        : recovery_bound(scenario_, failed_, delays().largest(time));
  }
  [[nodiscard]] model::Nanoseconds due(model::Nanoseconds time) const {
    return failed_ + bound(time);
  }
  void judge(model::Nanoseconds time) {
    if (!violation() && is_missing_something()) complain(due(time));
  }

  const model::Scenario scenario_;
  const std::optional<model::Nanoseconds> given_bound_;
  model::Nanoseconds failed_;
  model::Nanoseconds end_;
  bool undecided_ = false;
};

}  // namespace stormproof::props
