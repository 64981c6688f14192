// The ends of events, for monitors that judge what an event has caused. Most events cause nothing
// that they care about, so one probe hears of all ends and passes on those that were asked for.
#pragma once

#include <utility>
#include <vector>

#include "props/monitors/observer.hpp"

namespace stormproof::props {

class EventEnds final : public model::Probe {
 public:
  class Listener {
   public:
    virtual ~Listener() = default;
    virtual void event_ended(const model::Depths& depths) = 0;
  };

  [[nodiscard]] bool gathers_as(const EventEnds&) const { return true; }
  [[nodiscard]] model::Reports reports() const override {
    model::Reports reports;
    reports.set(model::Report::event_finished);
    return reports;
  }
  void event_finished(const model::Depths& depths) override {
    for (Listener* one : asked_) one->event_ended(depths);
    asked_.clear();
  }
  /// The listener hears of the end of this event; to be called once in it.
  void ask(Listener& listener) { asked_.push_back(&listener); }

 private:
  std::vector<Listener*> asked_;
};

/// A monitor that judges at the end of events in which it has asked for that.
class EndObserver : public Observer, private EventEnds::Listener {
 public:
  using Feeder = EndObserver;
  using Observer::Observer;

  void join(model::Company& company) override {
    Observer::join(company);
    ends_ = company.gatherer_like(ends_);
  }
  void event_finished(const model::Depths& depths) override {
    if (is_alone()) ends_->event_finished(depths);
  }

 protected:
  void await_end() {
    if (!std::exchange(awaits_, true)) ends_->ask(*this);
  }
  /// The event is over in which `await_end` was called.
  virtual void judge_event(const model::Depths& depths) = 0;

 private:
  void event_ended(const model::Depths& depths) final {
    awaits_ = false;
    judge_event(depths);
  }

  std::shared_ptr<EventEnds> ends_ = std::make_shared<EventEnds>();
  bool awaits_ = false;
};

}  // namespace stormproof::props
