// The monitor is one probe among others; a run that has nothing more to say is interrupted.
#include "checker/verification/counterexample/observe.hpp"

#include <utility>

#include "model/trace/probe_list.hpp"

namespace stormproof::counterexample {

namespace {

using model::trace::ProbeList;
using model::trace::TraceViolation;
using model::trace::ViolationWatch;

class MonitorWatch final : public ViolationWatch {
 public:
  explicit MonitorWatch(std::unique_ptr<props::Monitor> monitor) : monitor_{std::move(monitor)} {}

  void finish(model::Nanoseconds end) override { monitor_->finish(end); }
  [[nodiscard]] std::optional<TraceViolation> violation() const override {
    const auto& found = monitor_->violation();
    if (!found) return std::nullopt;
    return TraceViolation{std::string{monitor_->property()}, found->event, found->time,
                          found->reason};
  }
  [[nodiscard]] model::Probe& probe() override { return *monitor_; }

 private:
  std::unique_ptr<props::Monitor> monitor_;
};

}  // namespace

std::optional<props::Violation> observe(const model::Scenario& scenario, props::Monitor& monitor,
                                        model::Probe* also, std::uint64_t most_events) {
  ProbeList probes;
  if (also != nullptr) probes.add(*also);
  probes.add(monitor);
  model::RunOptions options;
  options.probe = &probes;
  options.max_events = most_events;
  options.on_progress = [&](const model::Progress&) { return !monitor.violation(); };
  const model::RunResult result = simulate(scenario, options);
  if (result.end != model::RunEnd::interrupted) {
    monitor.finish(model::trace::known_until(result, scenario));
  }
  return monitor.violation();
}

std::unique_ptr<ViolationWatch> watch_with(std::unique_ptr<props::Monitor> monitor) {
  if (!monitor) return nullptr;
  return std::make_unique<MonitorWatch>(std::move(monitor));
}

model::trace::WatchMaker catalogue_watches() {
  return [](const std::string& property, const model::Scenario& scenario) {
    return watch_with(props::make_monitor(property, scenario));
  };
}

}  // namespace stormproof::counterexample
