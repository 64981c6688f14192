// What every monitor needs: the number and the time of the event that is being processed, and the
// numbering of the deployment. Monitors see a run only through the probe, so that they hold for
// mutated rules, too; whatever they know of X, C and pending timers they gather from what happened.
#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/trace/selection.hpp"
#include "props/monitor.hpp"

namespace stormproof::props {

class Observer : public Monitor {
 public:
  explicit Observer(std::string_view property) : property_{property} {}

  [[nodiscard]] std::string_view property() const override { return property_; }

  [[nodiscard]] bool wants_single_packets() const override { return false; }
  void join(model::Company&) override { is_alone_ = false; }
  void run_started(const model::Topology& topology) override { topology_ = &topology; }
  void event_started(const model::Event& event) override {
    if (has_own_clock()) own_->begin(event);
  }

 protected:
  /// Objects to what happens in the current event.
  void object_now(std::string reason) { object(event(), now(), std::move(reason)); }
  /// The same; only the first objection is put into words.
  template <std::invocable Reason>
  void object_now(Reason&& reason) {
    if (!violation()) object_now(std::string{reason()});
  }

  [[nodiscard]] std::uint64_t event() const { return clock_->event; }
  [[nodiscard]] std::uint64_t events() const { return clock_->events; }
  [[nodiscard]] model::Nanoseconds now() const { return clock_->now; }
  /// Of the event.
  [[nodiscard]] model::EventKind kind() const { return clock_->kind; }
  /// Exists while the run lasts, not in `finish` and `remarks`.
  [[nodiscard]] const model::Topology& topology() const { return *topology_; }

  void read(const std::shared_ptr<const model::RunClock>& clock) { clock_ = clock; }
  /// Alone in a run it gathers itself what a list gathers for all.
  [[nodiscard]] bool is_alone() const { return is_alone_; }
  /// Alone, or if it does more when an event begins, it counts events itself.
  [[nodiscard]] bool has_own_clock() const { return clock_ == own_; }

 private:
  std::string_view property_;
  bool is_alone_ = true;
  const model::Topology* topology_ = nullptr;
  const std::shared_ptr<model::RunClock> own_ = std::make_shared<model::RunClock>();
  std::shared_ptr<const model::RunClock> clock_ = own_;
};

/// Of whose transitions a monitor hears, if not of all but the channels': `M::hears_machines`.
template <class M>
concept HearsSomeMachines = requires {
  M::hears_machines.size();
};

/// Of which kinds of events and packets it hears, if not of all: `M::selection_of_kinds`.
template <class M>
concept HearsSomeKinds = requires {
  M::selection_of_kinds;
};

/// Who does more when an event begins than to count it counts events itself, because the clock of a
/// list is at the next event then; unless that is how it reads it (`M::reads_clock`).
template <class M>
inline constexpr bool reads_clock = [] {
  if constexpr (requires { M::reads_clock; }) {
    return M::reads_clock;
  } else {
    return HearsSomeKinds<M>;
  }
}();

/// Whether a monitor that is not alone need not hear of something, because its function for that
/// only feeds what the list gathers then: it is one of a class whose `Feeder` is that class.
template <class Function>
inline constexpr bool only_feeds = false;
template <class Result, class Class, class... Args>
requires requires { typename Class::Feeder; }
inline constexpr bool only_feeds<Result (Class::*)(Args...)> =
    std::is_same_v<Class, typename Class::Feeder>;

/// A monitor that hears of nothing but what it has functions for. Channels have no relations, so no
/// monitor cares how they move.
template <class M>
class Attentive final : public M, public model::trace::Selective {
 public:
  using M::M;

  void join(model::Company& company) override {
    M::join(company);
    if (!counts_events || reads_clock<M>) this->read(company.clock);
  }
  [[nodiscard]] model::Reports reports() const override {
    using enum model::Report;
    using model::Probe;
    model::Reports reports;
    reports.set(event_started, this->has_own_clock() ||
                                   (counts_events && (this->is_alone() ||
                                                      !only_feeds<decltype(&M::event_started)>)));
    const auto hears = [&]([[maybe_unused]] model::Report report, [[maybe_unused]] auto own,
                           [[maybe_unused]] auto inherited) {
      const bool is_own = !std::is_same_v<decltype(own), decltype(inherited)>;
      reports.set(report, is_own && (this->is_alone() || !only_feeds<decltype(own)>));
    };
    hears(event_finished, &M::event_finished, &Probe::event_finished);
    if constexpr (HearsSomeMachines<M>) {
      for (const model::Report report : M::hears_machines) reports.set(report);
      reports.set(reader_transition, reports.has(reader_transition) || feeds_transitions());
    } else {
      for (const model::Report report : {transition, reader_transition, descriptor_transition})
        hears(report, &M::transition, &Probe::transition);
    }
    hears(effect, &M::effect, &Probe::effect);
    hears(scheduled, &M::scheduled, &Probe::scheduled);
    hears(rescheduled, &M::rescheduled, &Probe::rescheduled);
    hears(emitted, &M::emitted, &Probe::emitted);
    hears(service_started, &M::service_started, &Probe::service_started);
    hears(dropped, &M::dropped, &Probe::dropped);
    hears(source_completed, &M::source_completed, &Probe::source_completed);
    hears(arrived, &M::arrived, &Probe::arrived);
    hears(received, &M::received, &Probe::received);
    hears(looped_back, &M::looped_back, &Probe::looped_back);
    hears(backlog_changed, &M::backlog_changed, &Probe::backlog_changed);
    hears(waiting_changed, &M::waiting_changed, &Probe::waiting_changed);
    return reports;
  }

  [[nodiscard]] model::trace::Selection selection() const override {
    if constexpr (HearsSomeKinds<M>) return M::selection_of_kinds;
    return {};
  }

 private:
  /// Alone it has to see itself what readers take.
  [[nodiscard]] bool feeds_transitions() const {
    return this->is_alone() && requires { M::gathers_data; };
  }
  /// Whether it does more when an event begins than to count it.
  static constexpr bool counts_events =
      !std::is_same_v<decltype(&M::event_started), decltype(&Observer::event_started)>;
};

template <class M, class... Args>
[[nodiscard]] std::unique_ptr<M> attentive(Args&&... args) {
  return std::make_unique<Attentive<M>>(std::forward<Args>(args)...);
}

}  // namespace stormproof::props
