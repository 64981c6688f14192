// Three kinds of mistakes: a run of another scenario than the one asked for, a mutation of the
// rules (model/mutation.hpp), and a result or an observation that is not what happened.
#include "tests/props/laws/mistakes.hpp"

#include <functional>
#include <memory>

#include "fsm/machines.hpp"
#include "model/simulator.hpp"
#include "tests/props/laws/law_check.hpp"
#include "tests/props/laws/observations.hpp"

namespace stormproof::props {

namespace {

using model::EventKind;
using model::Nanoseconds;
using model::Scenario;
using Change = model::EventMutation::Change;

constexpr Nanoseconds ns{1};

/// Runs what `change` makes of the scenario.
Simulate of_other(std::function<void(Scenario&)> change) {
  return [change = std::move(change)](const Scenario& scenario, model::Probe* probe) {
    Scenario other = scenario;
    change(other);
    return correct(other, probe);
  };
}

/// Everything takes a little longer: on the channel, and without one.
void slow_down(Scenario& scenario, Nanoseconds by = ns) {
  scenario.wireless.one_way += by;
  scenario.wireless.overhead_unicast += by;
  for (model::PacketDelay& delay : scenario.wireless.packet_delays) delay.one_way += by;
  for (model::Stage& stage : scenario.wireless.stages) {
    if (stage.overhead_unicast) *stage.overhead_unicast += by;
  }
}

model::RunResult mutated(const Scenario& scenario, model::Probe* probe,
                         const model::Mutation& mutation) {
  model::RunOptions options;
  options.probe = probe;
  options.mutation = &mutation;
  options.max_events = 50'000;
  return model::simulate(scenario, options);
}

model::Mutation of_event(EventKind kind, Change change, Nanoseconds by = {}) {
  model::Mutation mutation;
  mutation.events.push_back({kind, change, by, {}});
  return mutation;
}

Simulate of_rules(const model::Mutation& mutation) {
  return [mutation](const Scenario& scenario, model::Probe* probe) {
    return mutated(scenario, probe, mutation);
  };
}

/// Reports another result.
Simulate misreported(std::function<void(model::RunResult&)> change) {
  return [change = std::move(change)](const Scenario& scenario, model::Probe* probe) {
    model::RunResult result = correct(scenario, probe);
    change(result);
    return result;
  };
}

/// Position of the row in the machine's table.
std::size_t row_number(std::string_view machine, std::string_view source, std::string_view event,
                       std::string_view target) {
  for (const fsm::MachineInfo& info : fsm::machines()) {
    if (info.name != machine) continue;
    for (std::size_t k = 0; k < info.rows.size(); ++k) {
      const fsm::RowInfo& row = info.rows[k];
      if (info.states[row.source] == source && info.events[row.event] == event &&
          info.states[row.target] == target) {
        return k;
      }
    }
  }
  return SIZE_MAX;
}

/// A run in which one row of a table is changed.
Simulate of_row(const std::string& machine, std::string_view source, std::string_view event,
                std::string_view target, fsm::TableMutation::Kind change) {
  model::Mutation mutation;
  mutation.tables.push_back({machine, row_number(machine, source, event, target), change, 0, 0});
  return of_rules(mutation);
}

void add_repetition(std::vector<Mistake>& list) {
  const auto calls = std::make_shared<int>(0);
  list.push_back({"law.determinism", "every other run is slower",
                  of_other([calls](Scenario& s) { slow_down(s, Nanoseconds{++*calls % 2}); })});
  list.push_back(
      {"law.observation", "an observed run forgets its ACKNACKs",
       [](const Scenario& scenario, model::Probe* probe) {
         if (probe == nullptr) return correct(scenario, nullptr);
         model::Mutation forgets = of_event(EventKind::ack_time, Change::forget);
         forgets.events.push_back({EventKind::acknack_generation, Change::forget, {}, {}});
         return mutated(scenario, probe, forgets);
       }});
  const auto by_limit = of_other(
      [](Scenario& s) { slow_down(s, Nanoseconds{1 + s.time_limit.count() / 1'000'000}); });
  list.push_back({"law.later-limit", "packets are slower with a later limit", by_limit});
  list.push_back({"law.earlier-limit", "packets are slower with a later limit", by_limit});
  list.push_back(
      {"law.run-until", "packets are slower until the time limit", of_other([](Scenario& s) {
         if (s.run_until == model::RunUntil::time_limit) slow_down(s);
       })});
  list.push_back({"law.unused-values", "packets are slower with limits", of_other([](Scenario& s) {
                    if (s.limits) slow_down(s);
                  })});
}

void add_names(std::vector<Mistake>& list) {
  list.push_back({"law.host-names", "host 0 is slower", of_other([](Scenario& s) {
                    slow_down(s, Nanoseconds{s.deployment.participants[0].host.value});
                  })});
  list.push_back({"law.route-names", "long names take time", of_other([](Scenario& s) {
                    const std::size_t length = s.wireless.stages.front().channel.size();
                    slow_down(s, Nanoseconds{static_cast<std::int64_t>(length)});
                  })});
  list.push_back({"law.participant-order", "participant 1 starts late",
                  of_other([](Scenario& s) { s.deployment.participants[1].start += ns; })});
}

void add_units(std::vector<Mistake>& list) {
  list.push_back({"law.time-translation", "packets are slower later",
                  of_other([](Scenario& s) { slow_down(s, s.deployment.participants[0].start); })});
  list.push_back(
      {"law.time-scaling", "an ACKNACK is generated 1 ns before it is due",
       of_rules(of_event(EventKind::acknack_generation, Change::shift, Nanoseconds{-1}))});
  list.push_back({"law.time-scaling", "a suppression ends 1 ns late",
                  of_rules(of_event(EventKind::suppression_end, Change::shift, ns))});
  list.push_back({"law.byte-scaling", "four bytes more a fragment", of_other([](Scenario& s) {
                    s.wireless.link_overhead_bytes += model::Bytes{4};
                  })});
}

void add_workload(std::vector<Mistake>& list) {
  list.push_back({"law.workload", "a delivery is not counted", misreported([](auto& result) {
                    if (result.useful_deliveries > 0) --result.useful_deliveries;
                  })});
  list.push_back({"law.workload", "initial DATA counted as repair", misreported([](auto& result) {
                    if (result.completed()) --result.counts.initial_data;
                  })});
  list.push_back({"law.homogeneous-forms", "a missing descriptor more",
                  misreported([](auto& result) { ++result.missing_count; })});
  list.push_back({"law.failure-free", "the answer to a HEARTBEAT is forgotten",
                  of_rules(of_event(EventKind::acknack_generation, Change::forget))});
}

void add_obligations(std::vector<Mistake>& list) {
  using TableChange = fsm::TableMutation::Kind;
  list.push_back({"law.silence", "nothing is ever acknowledged",
                  of_row("DescriptorRepair", "U", "AckNackReceived", "A", TableChange::drop_row)});
  list.push_back({"law.single-loss", "a repair is generated 1 ns late",
                  of_rules(of_event(EventKind::repair_generation, Change::shift, ns))});
  list.push_back({"law.double-loss", "the end of a suppression is forgotten",
                  of_rules(of_event(EventKind::suppression_end, Change::forget))});
  list.push_back({"law.answers", "an ACKNACK is generated 1 ns late",
                  of_rules(of_event(EventKind::acknack_generation, Change::shift, ns))});
  list.push_back({"law.initial-attempts", "initial ACKNACKs are forgotten",
                  of_rules(of_event(EventKind::initial_acknack_due, Change::forget))});
  list.push_back({"law.initial-attempts", "the interval of initial ACKNACKs is mistaken",
                  of_other([](Scenario& s) {
                    using enum model::InitialAckNackInterval;
                    auto& interval = s.dds.sedp.initial_acknack_interval;
                    interval = interval == doubling ? constant : doubling;
                  })});
  list.push_back({"law.announcements", "announcements are 1 ns late", of_other([](Scenario& s) {
                    s.dds.spdp.startup_period += ns;
                    s.dds.spdp.period += ns;
                  })});
  list.push_back({"law.work-conserving", "a channel that becomes free does not look who waits",
                  of_row("Channel", "Idle", "EffectsDone", "Idle", TableChange::drop_row)});
}

/// What both sides of a relation owe each other.
void add_exchange(std::vector<Mistake>& list) {
  list.push_back({"law.introductions", "nobody answers an announcement",
                  of_other([](Scenario& s) { s.dds.spdp.resend = model::SpdpResend::none; })});
  list.push_back({"law.introductions", "copies go to nobody else",
                  of_other([](Scenario& s) { s.dds.spdp.resend = model::SpdpResend::new_only; })});
  list.push_back({"law.first-words", "what should be pushed is pulled", of_other([](Scenario& s) {
                    s.dds.sedp.initial_data = model::InitialData::pull;
                  })});
  list.push_back({"law.requests", "a repair is generated 1 ns late",
                  of_rules(of_event(EventKind::repair_generation, Change::shift, ns))});
  list.push_back({"law.requests", "nobody responds to requests",
                  of_rules(of_event(EventKind::nack_response, Change::forget))});
  list.push_back({"law.reminders", "the HEARTBEAT timer never expires",
                  of_rules(of_event(EventKind::heartbeat_expiry, Change::forget))});
  list.push_back({"law.reminders", "the HEARTBEAT timer expires twice",
                  of_rules(of_event(EventKind::heartbeat_expiry, Change::duplicate))});
  list.push_back({"law.control", "an answer of a control-only relation is 1 ns late",
                  of_rules(of_event(EventKind::control_reply_due, Change::shift, ns))});
  list.push_back({"law.control", "attempts of control-only relations are forgotten",
                  of_rules(of_event(EventKind::control_initial_due, Change::forget))});
  list.push_back({"law.lookups", "participants know one type more", of_other([](Scenario& s) {
                    if (s.deployment.types) --s.deployment.types->unknown_per_participant;
                  })});
  list.push_back({"law.samples", "what is asked and answered is never announced",
                  of_rules(of_event(EventKind::lookup_expiry, Change::forget))});
}

void add_accounting(std::vector<Mistake>& list) {
  list.push_back({"law.counts", "an ACKNACK too many is counted",
                  misreported([](auto& result) { ++result.counts.acknack; })});
  list.push_back({"law.counts", "a repair counts as initial DATA", misreported([](auto& result) {
                    if (result.counts.repair_data == 0) return;
                    --result.counts.repair_data;
                    ++result.counts.initial_data;
                  })});
  list.push_back(
      {"law.deliveries", "discovery is complete 1 ns late", misreported([](auto& result) {
         if (result.completed()) *result.discovery_time += ns;
       })});
  list.push_back({"law.deliveries", "a duplicate is not counted", misreported([](auto& result) {
                    if (result.duplicate_deliveries > 0) --result.duplicate_deliveries;
                  })});
  list.push_back({"law.channel-use", "airtime in the wrong class", misreported([](auto& result) {
                    auto& busy = result.channels.front().busy;
                    std::swap(busy[0], busy[3]);
                  })});
  list.push_back({"law.delays", "a delay that is too long",
                  misreported([](auto& result) { result.latency[0].longest += ns; })});
}

void add_causality(std::vector<Mistake>& list) {
  list.push_back({"law.causality", "lost packets are received",
                  of_other([](Scenario& s) { s.wireless.lost_packets.clear(); })});
  list.push_back({"law.causality", "packets are 1 ns too fast",
                  of_other([](Scenario& s) { slow_down(s, Nanoseconds{-1}); })});
  list.push_back({"law.causality", "the service of a fragment ends 1 ns early",
                  of_rules(of_event(EventKind::service_finished, Change::shift, Nanoseconds{-1}))});
  list.push_back(
      {"law.delivered", "participants listen before they start", of_other([](Scenario& s) {
         for (auto& participant : s.deployment.participants) {
           participant.start = Nanoseconds{};
         }
       })});
  list.push_back(
      {"law.delivered", "states change without a packet", observed_as<WithoutReceptions>()});
  list.push_back(
      {"law.knowledge", "an ACKNACK confirms what never came", observed_as<WithoutReceptions>()});
}

void add_service(std::vector<Mistake>& list) {
  list.push_back({"law.single-stage-order", "one order is slower", of_other([](Scenario& s) {
                    if (s.wireless.order == model::ServiceOrder::fifo) slow_down(s);
                  })});
  list.push_back(
      {"law.unlimited-queue", "half of the queue is never used", of_other([](Scenario& s) {
         model::Bytes& queue = s.wireless.source_queue_bytes;
         if (queue == model::WirelessProfile::unlimited) return;
         queue = model::Bytes{1 + queue.count() / 2};
       })});
  list.push_back(
      {"law.unsent-losses", "a long list of losses takes time", of_other([](Scenario& s) {
         slow_down(s, Nanoseconds{static_cast<std::int64_t>(s.wireless.lost_packets.size())});
       })});
  list.push_back({"law.lost-is-late", "lost packets are received",
                  of_other([](Scenario& s) { s.wireless.lost_packets.clear(); })});
}

void add_bounds(std::vector<Mistake>& list) {
  list.push_back({"law.physical-bound", "packets take no time", of_other([](Scenario& s) {
                    s.wireless.kind = model::ServiceKind::constant_delay;
                    s.wireless.one_way = Nanoseconds{};
                    s.wireless.packet_delays.clear();
                  })});
  model::Mutation silent = of_event(EventKind::acknack_generation, Change::forget);
  list.push_back(
      {"law.completion-bound", "the answer to a HEARTBEAT is forgotten", of_rules(silent)});
}

void add_adaptive(std::vector<Mistake>& list) {
  list.push_back({"law.adaptive-period", "a cycle ends 1 ns before its period",
                  of_rules(of_event(EventKind::cycle_end, Change::shift, Nanoseconds{-1}))});
  using TableChange = fsm::TableMutation::Kind;
  const auto row = [](std::string_view target, TableChange change) {
    const std::string machine = "HeartbeatTimer";
    return fsm::TableMutation{machine, row_number(machine, "Pacing", "CycleStarted", target),
                              change, 0, 0};
  };
  model::Mutation endless;
  endless.tables = {row("Awaiting", TableChange::ignore_guard), row("Idle", TableChange::drop_row)};
  list.push_back({"law.adaptive-dies", "a cycle that asks nobody goes on", of_rules(endless)});
  list.push_back({"law.adaptive-recipients", "a cycle asks every matched reader",
                  observed_as<ExpiriesAreCycles>([](Scenario& s) {
                    s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::periodic;
                    s.dds.sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
                  })});
}

}  // namespace

std::vector<Mistake> mistakes() {
  std::vector<Mistake> list;
  add_repetition(list);
  add_names(list);
  add_units(list);
  add_workload(list);
  add_obligations(list);
  add_exchange(list);
  add_accounting(list);
  add_causality(list);
  add_service(list);
  add_bounds(list);
  add_adaptive(list);
  return list;
}

}  // namespace stormproof::props
