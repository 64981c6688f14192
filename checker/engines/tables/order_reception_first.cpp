// order.reception-first: a protocol decision at time t sees every reception that completes at t,
// and the channel picks its next fragment after both. The order of events gives that for receptions
// that are scheduled by then; that none is scheduled later needs services that take time, which is
// checked for the scenario.
#include <optional>

#include "checker/engines/tables/event_order_rules.hpp"
#include "checker/engines/tables/properties.hpp"
#include "model/airtime.hpp"
#include "model/engine/event_queue.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {
namespace {

using model::EventKind;

/// What the kinds are by their meaning, whatever their class.
Role role_of(EventKind kind) {
  switch (kind) {
    case EventKind::service_finished:
    case EventKind::delayed_reception:
    case EventKind::reception:
    case EventKind::distribution:
    case EventKind::beacon:
      return Role::reception;
    case EventKind::announcement_due:
    case EventKind::heartbeat_expiry:
    case EventKind::acknack_generation:
    case EventKind::initial_acknack_due:
    case EventKind::repair_generation:
    case EventKind::suppression_end:
    case EventKind::source_completion:
    case EventKind::cycle_start:
    case EventKind::cycle_end:
    case EventKind::batch_due:
    case EventKind::endpoint_creation:
    case EventKind::nack_response:
    case EventKind::async_run:
    case EventKind::control_initial_due:
    case EventKind::control_reply_due:
    case EventKind::lookup_expiry:
    case EventKind::participant_start:
    case EventKind::spdp_time:
    case EventKind::reply_time:
    case EventKind::lease_check:
    case EventKind::heartbeat_time:
    case EventKind::ack_time:
    case EventKind::thread_run:
    case EventKind::liveliness_time:
    case EventKind::address_time:
    case EventKind::client_announcement:
    case EventKind::client_sync:
    case EventKind::registration_expiry:
    case EventKind::registration_reply:
    case EventKind::registration_initial:
    case EventKind::learner_reply:
    case EventKind::learner_initial:
    case EventKind::relay_expiry:
    case EventKind::relay_response:
    case EventKind::relay_suppression_end:
    case EventKind::server_routine:
    case EventKind::server_routine_again:
    case EventKind::server_sending:
    case EventKind::thread_free:
      return Role::decision;
    case EventKind::dispatch:
      return Role::service_start;
  }
  return Role::other;
}

model::EventClass class_with(const model::Mutation& mistakes, EventKind kind) {
  model::EventClass result = model::class_of(kind);
  for (const model::EventMutation& mistake : mistakes.events) {
    if (mistake.kind == kind && mistake.change == model::EventMutation::Change::reclass) {
      result = mistake.event_class;
    }
  }
  return result;
}

/// An event of an unknown kind, with the class and role that its kind has.
struct KindedEvent {
  SymbolicEvent event;
  smt::SymbolicInt kind;
  Expr valid;

  KindedEvent(const std::string& name, const model::Mutation& mistakes)
      : event{SymbolicEvent::named(name)},
        kind{smt::SymbolicInt::named(name + ".kind")},
        valid{event.valid()} {
    Exprs cases;
    for (std::size_t k = 0; k < model::event_kind_count; ++k) {
      const auto value = static_cast<EventKind>(k);
      cases.push_back((kind == k && event.role == static_cast<int>(role_of(value)) &&
                       event.event_class == static_cast<int>(class_with(mistakes, value)))
                          .expr());
    }
    valid = valid && any_of(cases);
  }

  [[nodiscard]] std::string text(const z3::model& model) const {
    const auto k = std::stoul(value_text(model, kind.expr()));
    return std::string{model::name_of(static_cast<EventKind>(k))} + " (insertion " +
           value_text(model, event.insertion.expr()) + ")";
  }
};

/// Why some reception can be scheduled for the very instant at which it is caused; nothing if none
/// can.
std::optional<std::string> instant_service(const model::Scenario& scenario) {
  const model::WirelessProfile& wireless = scenario.wireless;
  const bool loops_back = model::traits_of(scenario.dds).discovers_same_host;
  if (loops_back && scenario.deployment.loopback_delay.count() < 1) {
    return "loopback_delay is 0 ns";
  }
  if (wireless.kind == model::ServiceKind::constant_delay) {
    if (wireless.one_way.count() < 1) return "one_way is 0 ns";
    for (const model::PacketDelay& delay : wireless.packet_delays) {
      if (delay.one_way.count() >= 1) continue;
      return "one_way of packet " + std::to_string(delay.packet) + " is 0 ns";
    }
    return std::nullopt;
  }
  // The smallest fragment carries one byte behind its headers.
  const std::int64_t bytes = 1 + model::ip_header_bytes + wireless.link_overhead_bytes.count();
  if (wireless.service == model::ServedBy::unit) {
    const model::ServiceRate several{wireless.aggregation.overhead.count(),
                                     wireless.rate_unicast.count()};
    if (several.airtime_ns(2 * bytes) < 1) return "the airtime of small frames in a unit is 0 ns";
  }
  for (const model::Stage& stage : wireless.stages) {
    for (const bool multicast : {false, true}) {
      if (model::service_rate(wireless, stage, multicast).airtime_ns(bytes) >= 1) continue;
      return "the airtime of a small fragment in stage " + stage.name + " is 0 ns";
    }
  }
  return std::nullopt;
}

}  // namespace

Finding order_reception_first(const CheckRequest& request) {
  Proof proof{"order.reception-first", request};
  const auto rule = order_rule(request);
  const KindedEvent first{"a", proof.mistakes()};
  const KindedEvent second{"b", proof.mistakes()};
  const auto role_is = [](const KindedEvent& event, Role role) {
    return (event.event.role == static_cast<int>(role)).expr();
  };
  const Expr common =
      first.valid && second.valid &&
      (first.event.time == second.event.time && first.event.insertion != second.event.insertion)
          .expr();
  const Expr not_first = !before(rule, first.event, second.event);

  const auto missed = proof.ask(
      "a reception comes after a decision of its instant",
      {common, role_is(first, Role::reception), role_is(second, Role::decision), not_first});
  if (missed.answer == smt::Answer::sat) {
    proof.violate(second.text(*missed.model) + " is processed before " + first.text(*missed.model) +
                  " of the same instant");
  }
  const auto early = proof.ask("the channel starts before another event of its instant",
                               {common, !role_is(first, Role::service_start),
                                role_is(second, Role::service_start), not_first});
  if (early.answer == smt::Answer::sat) {
    proof.violate(second.text(*early.model) + " is processed before " + first.text(*early.model) +
                  " of the same instant");
  }
  proof.assume(
      "Every service takes at least 1 ns, so that no decision at t causes a reception at "
      "t; checked for this scenario.");
  if (const auto reason = instant_service(proof.scenario())) {
    proof.give_up(*reason +
                  ": a reception can be scheduled for an instant whose decisions have "
                  "been taken already");
  } else {
    proof.detail("every service of the scenario takes at least 1 ns");
  }
  return proof.finish("for every pair of event kinds and the order of the event queue");
}

}  // namespace stormproof::tables
