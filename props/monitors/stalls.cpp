// live.no-stall: while a started receiver lacks a descriptor (X = 0), some pending event can still
// bring it there. It is stated over what the receiver has: if the writer wrongly believes it
// acknowledged, HEARTBEATs and timers do not count, only DATA on its way does. What counts when is
// in prospects_judgment.cpp. Only cross-host relations are looked at, each after the events that
// concern it.
#include "props/monitors/data_observer.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/event_ends.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/prospects.hpp"

namespace stormproof::props {

namespace {

class Stalls : public DataObserver<EndObserver> {
 public:
  static constexpr auto selection_of_kinds = Prospects::selection;

  explicit Stalls(const model::Scenario& scenario)
      : DataObserver{"live.no-stall"}, prospects_{scenario} {}

  void run_started(const model::Topology& topology) override {
    DataObserver::run_started(topology);
    topology_.emplace(topology);
    prospects_.run_started(topology);
  }
  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    prospects_.event_started(event);
    await_consequences();
  }
  void finish(model::Nanoseconds end) override {
    if (!topology_) return;
    prospects_.touch_all();
    judge(end);
  }
  void transition(const model::Transition& fired) override {
    DataObserver::transition(fired);
    prospects_.transition(fired);
    await_consequences();
  }
  void scheduled(std::uint64_t insertion, model::Nanoseconds, model::EventKind kind,
                 std::uint32_t subject) override {
    prospects_.scheduled(insertion, kind, subject);
    await_consequences();
  }
  void rescheduled(const model::Event& event, std::uint64_t insertion) override {
    prospects_.rescheduled(event, insertion);
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    prospects_.emitted(packet, source, destinations);
    await_consequences();
  }
  void source_completed(const model::Packet& packet) override {
    prospects_.source_completed(packet);
    await_consequences();
  }
  void arrived(const model::Packet& packet, bool lost) override {
    prospects_.arrived(packet, lost);
    await_consequences();
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    DataObserver::received(packet, receiver);
    prospects_.received(packet, receiver);
    await_consequences();
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {std::to_string(judged_) + " times a relation was looked at."};
  }

 private:
  void await_consequences() {
    if (prospects_.expects_end()) await_end();
  }
  void judge_event(const model::Depths&) override {
    if (prospects_.is_touched()) judge(now());
    prospects_.event_ended();
  }
  void judge(model::Nanoseconds time) {
    for (const std::uint32_t relation : prospects_.take_touched()) {
      const model::Pair& ends = topology_->pair(relation / 2);
      if (!ends.cross_host || time < topology_->start(ends.destination) || violation()) continue;
      ++judged_;
      if (lacking(relation) == 0) continue;
      const auto d = prospects_.hopeless(relation, x());
      if (!d) continue;
      object(event(), time,
             "From " + time_text(time) + " on nothing can bring " +
                 descriptor_text(*topology_, relation, *d) + ", which lacks it: " +
                 prospects_.situation(relation, *d) + ", and no DATA with it is under way.");
    }
  }

  Prospects prospects_;
  std::optional<model::Topology> topology_;  // a copy: needed after the run, too
  std::uint64_t judged_ = 0;
};

}  // namespace

MonitorPtr watch_stalls(const model::Scenario& scenario) {
  if (has_samples(scenario)) return watch_stalls_of_cyclone(scenario);
  return attentive<Stalls>(scenario);
}

}  // namespace stormproof::props
