// Mistakes in the rules around the tables: events, snapshots, knobs, and the order of events.
#include "checker/verification/mutate/mutants.hpp"

#include <algorithm>
#include <iterator>

#include "checker/verification/mutate/effect_mutants.hpp"
#include "checker/verification/mutate/table_mutants.hpp"

namespace stormproof::mutate {

namespace {

using Change = model::EventMutation::Change;
using model::EventClass;
using model::EventKind;
using model::Nanoseconds;

CatalogueEntry named(Kind kind, std::string id, std::string description, Concerns concerns) {
  CatalogueEntry entry;
  entry.kind = kind;
  entry.mutant.id = std::move(id);
  entry.mutant.description = std::move(description);
  entry.concerns = std::move(concerns);
  return entry;
}

CatalogueEntry event(std::string id, std::string description, EventKind kind, Change change,
                     Nanoseconds by = {}, EventClass event_class = {}) {
  CatalogueEntry entry =
      named(Kind::event, std::move(id), std::move(description), where_happens(kind));
  model::EventMutation mutation;
  mutation.kind = kind;
  mutation.change = change;
  mutation.by = by;
  mutation.event_class = event_class;
  entry.mutant.rules.events.push_back(mutation);
  return entry;
}

void add_events(std::vector<CatalogueEntry>& list) {
  list.insert(
      list.end(),
      {event("heartbeat-not-rescheduled", "the next HEARTBEAT expiry is forgotten",
             EventKind::heartbeat_expiry, Change::forget),
       event("acknack-forgotten", "the answer to a HEARTBEAT is forgotten",
             EventKind::acknack_generation, Change::forget),
       event("repair-forgotten", "the repair generation is forgotten", EventKind::repair_generation,
             Change::forget),
       event("response-forgotten", "the nack response is forgotten", EventKind::nack_response,
             Change::forget),
       event("suppression-end-forgotten", "the end of a suppression is forgotten",
             EventKind::suppression_end, Change::forget),
       event("expiry-doubled", "every HEARTBEAT expiry is scheduled twice",
             EventKind::heartbeat_expiry, Change::duplicate),
       event("repair-doubled", "the repair generation is scheduled twice",
             EventKind::repair_generation, Change::duplicate),
       event("acknack-a-nanosecond-early", "an ACKNACK is generated 1 ns before it is due",
             EventKind::acknack_generation, Change::shift, Nanoseconds{-1}),
       event("suppression-a-nanosecond-short", "a suppression ends 1 ns too early",
             EventKind::suppression_end, Change::shift, Nanoseconds{-1}),
       event("repair-a-nanosecond-late", "a repair is generated 1 ns too late",
             EventKind::repair_generation, Change::shift, Nanoseconds{1}),
       event("reception-after-decision", "a reception comes after the decisions of its instant",
             EventKind::delayed_reception, Change::reclass, {}, EventClass::dispatch),
       event("service-after-decision", "the end of a service comes after decisions",
             EventKind::service_finished, Change::reclass, {}, EventClass::protocol),
       event("dispatch-first", "the channel picks before the decisions of the instant",
             EventKind::dispatch, Change::reclass, {}, EventClass::service),
       event("ack-time-forgotten", "the timer of a reader of Cyclone DDS is forgotten",
             EventKind::ack_time, Change::forget),
       event("thread-a-nanosecond-late", "its event thread runs 1 ns too late",
             EventKind::thread_run, Change::shift, Nanoseconds{1}),
       event("acknack-before-reception", "an ACKNACK is generated before receptions of its instant",
             EventKind::acknack_generation, Change::reclass, {}, EventClass::service)});
}

void add_rules(std::vector<CatalogueEntry>& list) {
  CatalogueEntry live = named(Kind::snapshot, "live-bitmap",
                              "an ACKNACK asks for what is missing when it arrives", everywhere());
  live.mutant.rules.live_bitmaps = true;
  list.push_back(std::move(live));

  const auto knob = [&](std::string id, std::string description, Concerns concerns,
                        std::function<void(model::Scenario&)> change) {
    CatalogueEntry entry =
        named(Kind::knob, std::move(id), std::move(description), std::move(concerns));
    entry.mutant.knobs = std::move(change);
    list.push_back(std::move(entry));
  };
  knob(
      "additive-timers", "every suppression end adds an expiry", where_rules_are_knobs(),
      [](model::Scenario& s) { s.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive; });
  knob("suppression-zero", "a suppression lasts no time", everywhere(),
       [](model::Scenario& s) { s.dds.sedp.nack_suppression_duration = Nanoseconds{0}; });
  knob("attempts-mistake-interval", "initial ACKNACKs double a constant interval, or keep another",
       everywhere(), [](model::Scenario& s) {
         using enum model::InitialAckNackInterval;
         model::InitialAckNackInterval& interval = s.dds.sedp.initial_acknack_interval;
         interval = interval == doubling ? constant : doubling;
       });
  list.back().survives_because =
      "no property depends on the time between initial ACKNACKs; law.initial-attempts does";
  knob("attempts-at-once", "an initial ACKNACK asks before any packet can have arrived",
       where_rules_are_knobs(),
       [](model::Scenario& s) { s.dds.sedp.initial_acknack_delay = Nanoseconds{1}; });
  knob("queue-twice-as-large", "the source queue admits twice its bytes", everywhere(),
       [](model::Scenario& s) {
         model::Bytes& w = s.wireless.source_queue_bytes;
         if (w != model::WirelessProfile::unlimited) w = w * 2;
       });

  // Of rules for those that forget; the trials have scenarios for each.
  const auto amended = [&](std::string id, std::string description, auto change) {
    knob(std::move(id), std::move(description), where_rules_are_knobs(),
         [change](model::Scenario& s) {
           if (s.dds.amendments) change(*s.dds.amendments, s.dds);
         });
  };
  using Rules = model::Amendments;
  using Dds = model::DdsProfile;
  amended("attempts-end-early", "a reader asks no more once any HEARTBEAT has come",
          [](Rules& rules, Dds&) {
            rules.initial_acknack_stop = model::InitialAckNackStop::any_heartbeat;
          });
  amended("attempt-at-the-same-instant", "an initial ACKNACK is repeated in the same instant",
          [](Rules& rules, Dds&) {
            rules.initial_acknack_repeat = model::InitialAckNackRepeat::age_based_zero;
          });
  amended("late-attempt-resets", "an initial ACKNACK takes acknowledgments back at any time",
          [](Rules& rules, Dds&) { rules.late_initial = model::LateInitial::reset; });
  amended("acknack-answered-at-once", "every ACKNACK is answered by a HEARTBEAT",
          [](Rules& rules, Dds&) { rules.acknack_reply = model::AckNackReply::all; });
  amended("waits-for-the-dead", "the period of a writer follows its slowest reader",
          [](Rules&, Dds& dds) { dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive; });
  amended("announces-to-all", "whoever recognises somebody announces itself to all it knows",
          [](Rules&, Dds& dds) { dds.spdp.resend = model::SpdpResend::all_known; });
  amended("charged-with-everything", "each DATA is charged with all that was sent before",
          [](Rules&, Dds& dds) { dds.sedp.piggyback = model::Piggyback::cumulative; });

  const auto order = [&](std::string id, std::string description, checker::OrderRule rule) {
    CatalogueEntry entry = named(Kind::order, std::move(id), std::move(description), everywhere());
    entry.mutant.order = rule;
    list.push_back(std::move(entry));
  };
  order("order-pairwise", "the order of events is the paper's sentence, read pair by pair",
        checker::OrderRule::pairwise_prose);
  order("order-without-insertion", "events of one time and class have no order",
        checker::OrderRule::without_insertion);
  order("order-without-class", "events of one time come in the order of insertion",
        checker::OrderRule::without_class);
}

}  // namespace

std::vector<CatalogueEntry> mutants() {
  std::vector<CatalogueEntry> list = table_mutants();
  add_events(list);
  add_rules(list);
  std::vector<CatalogueEntry> effects = effect_mutants();
  std::ranges::move(effects, std::back_inserter(list));
  return list;
}

}  // namespace stormproof::mutate
