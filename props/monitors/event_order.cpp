// order.reception-first: a reception that completes at t is seen by every protocol decision of t,
// and a channel serves only after all other events of t (specs/guide/model.md, "Events and their
// order").
//
// Both say that processed events ascend in (time, class, insertion number), where the class is that
// of the event's kind and not what the queue was told. A link without any delay breaks it: what a
// decision of t emits arrives at t, after that decision and perhaps after others.
#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

namespace {

class EventOrder : public Observer {
 public:
  static constexpr bool reads_clock = true;

  EventOrder() : Observer{"order.reception-first"} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (event.time < last_.time) {
      object_now(fmt::format("{} of {} comes after {} of {}: time runs backwards.",
                             name_of(event.kind), time_text(event.time), name_of(last_.kind),
                             time_text(last_.time)));
    } else if (events() > 1 && event.time == last_.time) {
      compare(event);
    }
    last_ = {event.time, event.insertion(), event.kind};
  }

 private:
  void compare(const model::Event& event) {
    const model::EventClass before = class_of(last_.kind);
    const model::EventClass after = class_of(event.kind);
    if (after < before) {
      object_now(fmt::format("At {} {} ({}) is processed after {} ({}), which should have seen it.",
                             time_text(event.time), name_of(event.kind), name_of(after),
                             name_of(last_.kind), name_of(before)));
    } else if (after == before && event.insertion() < last_.insertion) {
      object_now(fmt::format("At {} {} (inserted as number {}) comes after {} (number {}).",
                             time_text(event.time), name_of(event.kind), event.insertion(),
                             name_of(last_.kind), last_.insertion));
    }
  }

  struct Last {
    model::Nanoseconds time;
    std::uint64_t insertion = 0;
    model::EventKind kind{};
  };
  Last last_;
};

}  // namespace

MonitorPtr watch_event_order(const model::Scenario&) { return attentive<EventOrder>(); }

}  // namespace stormproof::props
