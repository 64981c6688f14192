// What participants do not agree on is counted by the run (model/cyclone/living_completion.hpp,
// model/engine/living_host.hpp): endpoints that one has and the other does not know, or knows and
// that exist no more, and participants that are gone and still known. The event that the monitor
// objects to is the last one that changed something of it.
#include "props/monitors/recovery_as_counted.hpp"

#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/recovery_observer.hpp"

namespace stormproof::props {

namespace {

class RecoveryAsCounted : public RecoveryObserver {
 public:
  using RecoveryObserver::RecoveryObserver;

  void event_finished(const model::Depths& depths) override {
    if (depths.missing == missing_) return;
    missing_ = depths.missing;
    changed_by_ = event();
    changed_ = now();
  }

 protected:
  [[nodiscard]] bool is_missing_something() const override { return missing_ > 0; }
  void complain(model::Nanoseconds due) override {
    object(changed_by_, changed_,
           fmt::format(
               "Until {} nothing more is learned: {} that somebody has and another one "
               "does not know, or that is gone and still known, and nothing has failed "
               "since {}.",
               time_text(due),
               missing_ == 1 ? "there is 1 thing" : fmt::format("there are {} things", missing_),
               time_text(failed())));
  }

 private:
  std::uint64_t missing_ = UINT64_MAX;  ///< nothing is known before the first event
  std::uint64_t changed_by_ = 0;
  model::Nanoseconds changed_;
};

}  // namespace

MonitorPtr watch_recovery_as_counted(const model::Scenario& scenario,
                                     std::optional<model::Nanoseconds> bound) {
  return attentive<RecoveryAsCounted>(scenario, bound);
}

}  // namespace stormproof::props
