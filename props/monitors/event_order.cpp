// order.reception-first: a reception that completes at t is seen by every protocol decision of t,
// and a channel serves only after all other events of t (specs/guide/model.md, "Events and their
// order").
//
// Both say that processed events ascend in (time, class, insertion number), where the class is that
// of the event's kind and not what the queue was told. A link without any delay breaks it: what a
// decision of t emits arrives at t, after that decision and perhaps after others.
#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/instants.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::props {

namespace {

class EventOrder : public InstantObserver {
 public:
  EventOrder() : InstantObserver{"order.reception-first"} {}

 private:
  void out_of_order(const Instants::Place& before, const model::Event& event) override {
    const model::EventClass should_see = class_of(before.kind);
    const model::EventClass should_be_seen = class_of(event.kind);
    if (event.time < before.time) {
      object_now(fmt::format("{} of {} comes after {} of {}: time runs backwards.",
                             name_of(event.kind), time_text(event.time), name_of(before.kind),
                             time_text(before.time)));
    } else if (should_be_seen < should_see) {
      object_now(fmt::format("At {} {} ({}) is processed after {} ({}), which should have seen it.",
                             time_text(event.time), name_of(event.kind), name_of(should_be_seen),
                             name_of(before.kind), name_of(should_see)));
    } else {
      object_now(fmt::format("At {} {} (inserted as number {}) comes after {} (number {}).",
                             time_text(event.time), name_of(event.kind), event.insertion(),
                             name_of(before.kind), before.insertion));
    }
  }
};

}  // namespace

MonitorPtr watch_event_order(const model::Scenario&) { return attentive<EventOrder>(); }

}  // namespace stormproof::props
