// What participants do not agree on is counted by the run (model/cyclone/living_completion.hpp):
// endpoints that one has and the other does not know, or knows and that exist no more, and
// participants that are gone and still known. The event that the monitor objects to is the last one
// that changed something of it.
#include "props/monitors/recovery_of_samples.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "model/life.hpp"
#include "props/monitors/delay_observer.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/recovery_bound.hpp"

namespace stormproof::props {

namespace {

class RecoveryOfSamples : public DelayObserver {
 public:
  RecoveryOfSamples(const model::Scenario& scenario, std::optional<model::Nanoseconds> bound)
      : DelayObserver{"live.recovery", scenario},
        scenario_{scenario},
        given_bound_{bound},
        failed_{last_failure(scenario.deployment)} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (event.time > failed_ && event.time > due(event.time)) judge(event.time);
  }
  void event_finished(const model::Depths& depths) override {
    if (depths.missing == missing_) return;
    missing_ = depths.missing;
    changed_by_ = event();
    changed_ = now();
  }
  void arrived(const model::Packet& packet, bool lost) override {
    DelayObserver::arrived(packet, lost);
    if (lost) failed_ = std::max(failed_, now());
  }
  void finish(model::Nanoseconds end) override {
    end_ = end;
    undecided_ = end < due(end) && missing_ > 0;
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
    if (violation() || missing_ == 0) return;
    object(changed_by_, changed_,
           fmt::format(
               "Until {} nothing more is learned: {} that somebody has and another one "
               "does not know, or that is gone and still known, and nothing has failed "
               "since {}.",
               time_text(due(time)),
               missing_ == 1 ? "there is 1 thing" : fmt::format("there are {} things", missing_),
               time_text(failed_)));
  }

  const model::Scenario scenario_;
  const std::optional<model::Nanoseconds> given_bound_;
  std::uint64_t missing_ = UINT64_MAX;  ///< nothing is known before the first event
  std::uint64_t changed_by_ = 0;
  model::Nanoseconds changed_;
  model::Nanoseconds failed_;  ///< when something failed last, so far
  model::Nanoseconds end_;
  bool undecided_ = false;
};

}  // namespace

MonitorPtr watch_recovery_of_samples(const model::Scenario& scenario,
                                     std::optional<model::Nanoseconds> bound) {
  return attentive<RecoveryOfSamples>(scenario, bound);
}

}  // namespace stormproof::props
