// Instants of a run, for monitors that judge them: whether events come in their order, whether one
// instant has too many, and what is true when one is over. Nearly always nothing is to be said, so
// one probe looks at every event and tells what somebody waits for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "props/monitors/observer.hpp"

namespace stormproof::props {

class Instants final : public model::Probe {
 public:
  using Nanoseconds = model::Nanoseconds;
  static constexpr std::uint64_t most = 10'000;
  static constexpr Nanoseconds never{std::numeric_limits<std::int64_t>::max()};

  /// What orders events.
  struct Place {
    Nanoseconds time;
    std::uint64_t insertion = 0;
    model::EventKind kind{};
  };
  class Listener {
   public:
    virtual ~Listener() = default;
    /// The event does not belong behind the one before it.
    virtual void out_of_order(const Place& /*before*/, const model::Event&) {}
    /// The event is behind the first `most` ones of its instant.
    virtual void crowded(const model::Event&) {}
    /// Nothing happens between the two, of which the second is behind the listener's horizon.
    virtual void over(Nanoseconds /*from*/, Nanoseconds /*to*/) {}
  };

  [[nodiscard]] bool gathers_as(const Instants&) const { return true; }
  [[nodiscard]] model::Reports reports() const override {
    model::Reports reports;
    reports.set(model::Report::event_started);
    return reports;
  }
  /// Its number here.
  std::size_t listen(Listener& listener) {
    listeners_.push_back(&listener);
    horizons_.push_back(never);
    return listeners_.size() - 1;
  }
  /// Listener k waits for the first instant after that.
  void wait_beyond(std::size_t k, Nanoseconds horizon) {
    horizons_[k] = horizon;
    horizon_ = std::ranges::min(horizons_);
  }

  void event_started(const model::Event& event) override {
    if (event.time > last_.time) {
      if (event.time > horizon_) tell_over(event.time);
      count_ = 0;
    } else if (any_ && !is_behind_last(event)) {
      for (Listener* one : listeners_) one->out_of_order(last_, event);
    }
    if (++count_ > most) {
      for (Listener* one : listeners_) one->crowded(event);
    }
    any_ = true;
    last_ = {event.time, event.insertion(), event.kind};
  }
  /// Of the last event.
  [[nodiscard]] Nanoseconds now() const { return last_.time; }

 private:
  /// Of an event that is not later.
  [[nodiscard]] bool is_behind_last(const model::Event& event) const {
    if (event.time < last_.time) return false;
    const model::EventClass before = class_of(last_.kind);
    const model::EventClass after = class_of(event.kind);
    return before < after || (before == after && last_.insertion <= event.insertion());
  }
  void tell_over(Nanoseconds to) {
    for (std::size_t k = 0; k < listeners_.size(); ++k) {
      if (to > horizons_[k]) listeners_[k]->over(last_.time, to);
    }
  }

  std::vector<Listener*> listeners_;
  std::vector<Nanoseconds> horizons_;  // of each
  Nanoseconds horizon_ = never;        // the first of them
  Place last_;
  bool any_ = false;
  std::uint64_t count_ = 0;  // events of this instant
};

/// A monitor of instants. What it waits for is told while the event is the current one.
class InstantObserver : public Observer, private Instants::Listener {
 public:
  using Feeder = InstantObserver;
  static constexpr bool reads_clock = true;

  explicit InstantObserver(std::string_view property) : Observer{property} {}

  void join(model::Company& company) override {
    Observer::join(company);
    const auto own = std::exchange(instants_, company.gatherer_like(instants_));
    if (instants_ != own) number_ = instants_->listen(*this);
  }
  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (is_alone()) instants_->event_started(event);
  }

 protected:
  [[nodiscard]] const Instants& instants() const { return *instants_; }
  void wait_beyond(model::Nanoseconds horizon) { instants_->wait_beyond(number_, horizon); }

 private:
  std::shared_ptr<Instants> instants_ = std::make_shared<Instants>();
  std::size_t number_ = instants_->listen(*this);
};

}  // namespace stormproof::props
