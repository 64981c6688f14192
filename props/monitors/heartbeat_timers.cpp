// timer.single-heartbeat: a writer never has two HEARTBEAT expiries pending. With the adaptive
// policy: at most one cycle start or cycle end is pending and not void. The expiry that is being
// processed is not pending any more. The six rules of the paper read literally
// (`heartbeat_timer: additive`) break it: the end of a suppression adds an expiry to the one that
// is pending.
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/pending_heartbeats.hpp"

namespace stormproof::props {

namespace {

class HeartbeatTimers : public Observer {
 public:
  static constexpr std::array hears_machines{model::Report::transition};
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}.only({model::Report::event_started, model::Report::scheduled},
                                     {model::EventKind::heartbeat_expiry,
                                      model::EventKind::cycle_start, model::EventKind::cycle_end});

  HeartbeatTimers() : Observer{"timer.single-heartbeat"} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    pending_.reset(topology);
  }
  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    pending_.started(event);
  }
  void transition(const model::Transition& fired) override {
    pending_.transition(fired.machine, fired.event, fired.after);
  }
  void scheduled(std::uint64_t insertion, model::Nanoseconds due, model::EventKind kind,
                 std::uint32_t subject) override {
    if (!pending_.scheduled(insertion, kind, subject)) return;
    ++scheduled_;
    if (pending_.count(subject) < 2) return;
    object_now("At " + time_text(now()) + " a " + name_of(kind) + " of " + writer_text(subject) +
               " is scheduled for " + time_text(due) + ", while another one is pending.");
  }
  void rescheduled(const model::Event& event, std::uint64_t insertion) override {
    pending_.rescheduled(event, insertion);
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {std::to_string(scheduled_) + " HEARTBEAT timer events were scheduled."};
  }

 private:
  PendingHeartbeats pending_;
  std::uint64_t scheduled_ = 0;
};

}  // namespace

MonitorPtr watch_heartbeat_timers(const model::Scenario&) { return attentive<HeartbeatTimers>(); }

}  // namespace stormproof::props
