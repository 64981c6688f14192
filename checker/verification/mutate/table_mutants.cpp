// Mistakes in the transition tables. Rows are named by what they say, not by their number, so that
// a table can grow without renumbering this list.
#include "checker/verification/mutate/table_mutants.hpp"

#include <cstdio>
#include <cstdlib>

#include "fsm/machines.hpp"

namespace stormproof::mutate {

namespace {

using Kind = fsm::TableMutation::Kind;

[[noreturn]] void unknown(std::string_view what) {
  std::fprintf(stderr, "internal error: the list of mutants names %.*s, which does not exist\n",
               static_cast<int>(what.size()), what.data());
  std::_Exit(70);
}

const fsm::MachineInfo& machine_named(std::string_view name) {
  static const std::vector<fsm::MachineInfo> all = fsm::machines();
  for (const fsm::MachineInfo& machine : all) {
    if (machine.name == name) return machine;
  }
  unknown(name);
}

std::uint8_t state_named(const fsm::MachineInfo& machine, std::string_view state) {
  for (std::size_t k = 0; k < machine.states.size(); ++k) {
    if (machine.states[k] == state) return static_cast<std::uint8_t>(k);
  }
  unknown(state);
}

/// A row: "U AckNackReceived R", the source, event and target of exactly one row of the machine.
struct RowName {
  std::string_view machine;
  std::string_view source;
  std::string_view event;
  std::string_view target;
};

std::size_t position(const RowName& name) {
  const fsm::MachineInfo& machine = machine_named(name.machine);
  std::size_t found = machine.rows.size();
  for (std::size_t k = 0; k < machine.rows.size(); ++k) {
    const fsm::RowInfo& row = machine.rows[k];
    if (machine.states[row.source] != name.source || machine.events[row.event] != name.event ||
        machine.states[row.target] != name.target) {
      continue;
    }
    if (found != machine.rows.size()) unknown(name.event);  // not unique
    found = k;
  }
  if (found == machine.rows.size()) unknown(name.event);
  return found;
}

CatalogueEntry entry(std::string id, std::string description, const RowName& row, Kind kind) {
  CatalogueEntry result;
  result.mutant.id = std::move(id);
  result.mutant.description = std::move(description);
  fsm::TableMutation mutation;
  mutation.machine = row.machine;
  mutation.row = position(row);
  mutation.kind = kind;
  result.mutant.rules.tables.push_back(mutation);
  result.concerns = where_is_fed(row.machine, row.event);
  return result;
}

CatalogueEntry lead_to(CatalogueEntry entry, std::string_view target) {
  fsm::TableMutation& mutation = entry.mutant.rules.tables.front();
  mutation.target = state_named(machine_named(mutation.machine), target);
  return entry;
}

CatalogueEntry from(CatalogueEntry entry, std::string_view source) {
  fsm::TableMutation& mutation = entry.mutant.rules.tables.front();
  mutation.source = state_named(machine_named(mutation.machine), source);
  return entry;
}

void add_descriptor_repair(std::vector<CatalogueEntry>& list) {
  const auto row = [](std::string_view source, std::string_view event, std::string_view target) {
    return RowName{"DescriptorRepair", source, event, target};
  };
  const RowName request = row("U", "AckNackReceived", "R");
  const RowName confirm = row("U", "AckNackReceived", "A");
  const RowName due = row("R", "RepairDue", "Q");
  const RowName sent = row("Q", "RepairSent", "S");
  const RowName ended = row("S", "SuppressionEnded", "U");
  list.insert(
      list.end(),
      {entry("repair-never-requested", "an ACKNACK that lists a descriptor requests nothing",
             request, Kind::drop_row),
       entry("repair-never-generated", "a requested descriptor stays requested", due,
             Kind::drop_row),
       entry("repair-never-leaves", "a repair that has left the source stays queued", sent,
             Kind::drop_row),
       entry("suppression-never-ends", "a suppressed descriptor stays suppressed", ended,
             Kind::drop_row),
       entry("never-acknowledged", "an ACKNACK confirms nothing that is unacknowledged", confirm,
             Kind::drop_row),
       entry("suppressed-not-confirmed", "an ACKNACK confirms nothing that is suppressed",
             row("S", "AckNackReceived", "A"), Kind::drop_row),
       entry("queued-not-confirmed", "an ACKNACK confirms nothing that is queued",
             row("Q", "AckNackReceived", "A"), Kind::drop_row),
       entry("requests-everything", "an ACKNACK requests whatever it does not mention, too",
             request, Kind::ignore_guard),
       lead_to(entry("requests-unlisted", "an ACKNACK requests what it does not list", confirm,
                     Kind::retarget),
               "R"),
       entry("acknowledges-everything", "an ACKNACK confirms also what it lists as missing",
             confirm, Kind::ignore_guard),
       entry("acknowledges-queued", "an ACKNACK confirms whatever is queued",
             row("Q", "AckNackReceived", "A"), Kind::ignore_guard),
       entry("bitmap-inverted", "the bitmap is read as what has been received", request,
             Kind::negate_guard),
       entry("confirmation-inverted", "what the bitmap lists is confirmed", confirm,
             Kind::negate_guard),
       lead_to(entry("no-suppression", "a repair that has left the source can be asked for at once",
                     sent, Kind::retarget),
               "U"),
       lead_to(entry("delivery-assumed", "the end of the suppression counts as a confirmation",
                     ended, Kind::retarget),
               "A"),
       lead_to(entry("request-skips-generation", "a requested descriptor counts as queued", request,
                     Kind::retarget),
               "Q"),
       lead_to(entry("repair-returns-to-requested", "the end of the suppression requests again",
                     ended, Kind::retarget),
               "R"),
       lead_to(from(entry("acknowledgment-not-final", "an older ACKNACK takes a confirmation back",
                          request, Kind::copy_row),
                    "A"),
               "R"),
       lead_to(from(entry("suppressed-requests", "requests are accepted during the suppression",
                          request, Kind::copy_row),
                    "S"),
               "R"),
       lead_to(from(entry("queued-requests", "requests are accepted while the repair is queued",
                          request, Kind::copy_row),
                    "Q"),
               "R"),
       lead_to(from(entry("repairs-unasked", "repair generation takes all that is unacknowledged",
                          due, Kind::copy_row),
                    "U"),
               "Q"),
       entry("repair-not-scheduled", "a request does not schedule the repair generation", request,
             Kind::drop_action),
       entry("repair-not-sent", "a due repair is queued without DATA", due, Kind::drop_action)});
  CatalogueEntry rearm =
      entry("suppression-does-not-rearm",
            "the end of a suppression does not arm the HEARTBEAT timer", ended, Kind::drop_action);
  rearm.survives_because =
      "With a single timer the rule has no effect: a descriptor that leaves S is not acknowledged, "
      "so the timer of its writer is armed already (HeartbeatTimer, Idle on SuppressionEnded, "
      "never "
      "occurs).";
  list.push_back(std::move(rearm));
}

void add_reader(std::vector<CatalogueEntry>& list) {
  const auto row = [](std::string_view source, std::string_view event, std::string_view target) {
    return RowName{"DiscoveryReader", source, event, target};
  };
  list.insert(
      list.end(),
      {entry("heartbeat-ignored", "a reader that misses something does not answer HEARTBEATs",
             row("Recognised", "HeartbeatReceived", "Recognised"), Kind::drop_row),
       entry("complete-reader-silent", "a reader that has everything does not answer HEARTBEATs",
             row("Complete", "HeartbeatReceived", "Complete"), Kind::drop_row),
       entry("last-data-dropped", "the DATA that completes a reader is dropped",
             row("Recognised", "DataReceived", "Complete"), Kind::drop_row),
       entry("complete-too-early", "every DATA completes the reader",
             row("Recognised", "DataReceived", "Complete"), Kind::ignore_guard),
       lead_to(entry("opens-complete", "a reader side opens as if nothing were missing",
                     row("Unknown", "AnnouncementReceived", "Recognised"), Kind::retarget),
               "Complete"),
       entry("acknack-not-sent", "a due ACKNACK is not sent",
             row("Recognised", "AckNackDue", "Recognised"), Kind::drop_action),
       entry("data-not-taken", "DATA changes nothing at the receiver",
             row("Recognised", "DataReceived", "Recognised"), Kind::drop_action),
       entry("initial-acknack-not-sent", "a due initial ACKNACK has no row",
             row("Recognised", "InitialAckNackDue", "Recognised"), Kind::drop_row)});
}

void add_timers(std::vector<CatalogueEntry>& list) {
  const auto timer = [](std::string_view source, std::string_view event, std::string_view target) {
    return RowName{"HeartbeatTimer", source, event, target};
  };
  list.insert(
      list.end(),
      {entry("expiry-not-handled", "an expiry with nothing unacknowledged has no row",
             RowName{"HeartbeatTimer", "Armed", "Expired", "Idle"}, Kind::drop_row),
       entry("suppression-arms-again", "the end of a suppression arms an armed timer again",
             timer("Armed", "SuppressionEnded", "Armed"), Kind::ignore_guard),
       entry("timer-never-dies", "an expiry with nothing unacknowledged ends nothing",
             timer("Armed", "Expired", "Idle"), Kind::negate_guard),
       entry("timer-not-scheduled", "arming an idle timer schedules nothing",
             timer("Idle", "ArmRequested", "Armed"), Kind::drop_action),
       lead_to(entry("armed-looks-idle", "an armed timer counts as idle",
                     timer("Idle", "ArmRequested", "Armed"), Kind::retarget),
               "Idle"),
       entry("adaptive-cycle-never-ends", "a cycle of the adaptive policy has no end",
             timer("Awaiting", "CycleEnded", "Pacing"), Kind::drop_row),
       entry("attempts-never-end", "an initial ACKNACK is tried whatever has been seen",
             RowName{"InitialAckNack", "Waiting", "AttemptDue", "Waiting"}, Kind::ignore_guard),
       entry("attempts-end-unseen", "initial ACKNACKs end before a HEARTBEAT has been seen",
             RowName{"InitialAckNack", "Waiting", "AttemptDue", "Done"}, Kind::negate_guard),
       entry("announcements-end", "the periodic announcements have no row",
             RowName{"Announcer", "Periodic", "AnnouncementDue", "Periodic"}, Kind::drop_row)});
}

void add_channel(std::vector<CatalogueEntry>& list) {
  const auto row = [](std::string_view source, std::string_view event, std::string_view target) {
    return RowName{"Channel", source, event, target};
  };
  list.insert(list.end(),
              {entry("channel-idles", "a channel that becomes free does not look who waits",
                     row("Idle", "EffectsDone", "Idle"), Kind::drop_row),
               entry("dispatch-forgotten", "a request at an idle channel schedules no dispatch",
                     row("Idle", "ServiceRequested", "Idle"), Kind::drop_action),
               entry("dispatch-doubled", "every request at an idle channel schedules a dispatch",
                     row("Idle", "ServiceRequested", "Idle"), Kind::ignore_guard)});
}

void add_fastdds(std::vector<CatalogueEntry>& list) {
  const auto row = [](std::string_view source, std::string_view event, std::string_view target) {
    return RowName{"ChangeForReader", source, event, target};
  };
  const RowName request = row("U", "AckNackReceived", "R");
  list.insert(
      list.end(),
      {entry("base-ignored", "an ACKNACK confirms whatever its base says",
             row("U", "AckNackReceived", "A"), Kind::ignore_guard),
       entry("base-inverted", "an ACKNACK confirms what is not below its base",
             row("S", "AckNackReceived", "A"), Kind::negate_guard),
       entry("change-never-requested", "a listed change is not requested", request, Kind::drop_row),
       entry("request-without-response", "a request asks for no nack response", request,
             Kind::drop_action),
       entry("response-without-queue", "the nack response puts nothing into the queue",
             row("R", "NackResponseDue", "Q"), Kind::drop_action),
       entry("change-stays-suppressed", "the end of the suppression changes nothing",
             row("S", "SuppressionEnded", "U"), Kind::drop_row),
       lead_to(entry("change-assumed-delivered", "the end of the suppression is a confirmation",
                     row("S", "SuppressionEnded", "U"), Kind::retarget),
               "A"),
       lead_to(entry("serialized-not-suppressed", "a serialized change can be asked for at once",
                     row("Q", "Serialized", "S"), Kind::retarget),
               "U"),
       entry("initial-acknack-keeps-state", "an initial ACKNACK takes no confirmation back",
             row("A", "InitialAckNackReceived", "U"), Kind::drop_row),
       lead_to(from(entry("single-shot-doubled", "a pending timer is scheduled once more",
                          RowName{"SingleShot", "Idle", "Requested", "Pending"}, Kind::copy_row),
                    "Pending"),
               "Pending"),
       lead_to(entry("single-shot-stuck", "a timer that was due counts as pending",
                     RowName{"SingleShot", "Pending", "Due", "Idle"}, Kind::retarget),
               "Pending"),
       entry("control-reader-silent", "a control-only reader does not answer HEARTBEATs",
             RowName{"ControlReader", "Open", "HeartbeatReceived", "Open"}, Kind::drop_row),
       entry("control-writer-silent", "a control-only writer does not answer initial ACKNACKs",
             RowName{"ControlWriter", "Open", "InitialAckNackReceived", "Open"}, Kind::drop_row),
       lead_to(entry("control-writer-closed", "a control-only writer that opens stays closed",
                     RowName{"ControlWriter", "Closed", "Opened", "Open"}, Kind::retarget),
               "Closed")});
}

void add_cyclone(std::vector<CatalogueEntry>& list) {
  const RowName silent{"MatchedReader", "Silent", "AckNackReceived", "Silent"};
  const RowName takes{"CautiousReader", "Answered", "DataReceived", "Answered"};
  const RowName addressed{"CautiousReader", "Answered", "HeartbeatReceived", "Addressed"};
  list.insert(
      list.end(),
      {entry("cautious-reader-closed", "a reader of Cyclone DDS never opens",
             {"CautiousReader", "Closed", "Opened", "Unheard"}, Kind::drop_row),
       entry("never-pre-empts", "such a reader sends no pre-emptive ACKNACK",
             {"CautiousReader", "Unheard", "TimerFired", "Unheard"}, Kind::drop_row),
       lead_to(from(entry("data-before-heartbeat", "it takes DATA before any HEARTBEAT", takes,
                          Kind::copy_row),
                    "Unheard"),
               "Unheard"),
       lead_to(entry("directed-as-any", "a directed HEARTBEAT counts as any other", addressed,
                     Kind::retarget),
               "Heard"),
       lead_to(entry("any-acknack-replies", "an ACKNACK counts as a reply, whatever it says",
                     silent, Kind::retarget),
               "Replied"),
       entry("replied-not-taken", "of who has replied no ACKNACK is taken",
             {"MatchedReader", "Replied", "AckNackReceived", "Replied"}, Kind::drop_row),
       entry("pacer-rests", "a writer at rest hears of no new reader",
             {"HeartbeatPacer", "Resting", "Matched", "Pacing"}, Kind::drop_row),
       entry("pacer-not-hastened", "a new or repeated sample does not hasten HEARTBEATs",
             {"HeartbeatPacer", "Pacing", "Hastened", "Pacing"}, Kind::drop_row),
       entry("thread-sleeps", "the event thread is not woken",
             {"EventThread", "Asleep", "Woken", "Expected"}, Kind::drop_row),
       lead_to(entry("thread-sleeps-after-a-copy", "it sleeps after the first copy of a packet",
                     {"EventThread", "Working", "CopySent", "Expected"}, Kind::retarget),
               "Asleep"),
       entry("timer-fires-early", "a timer of the thread fires whatever it was moved to",
             {"MovableTimer", "Scheduled", "Came", "Listed"}, Kind::ignore_guard),
       entry("timer-moves-later", "such a timer can be moved to a later time",
             {"MovableTimer", "Scheduled", "Moved", "Scheduled"}, Kind::ignore_guard)});
}

}  // namespace

std::vector<CatalogueEntry> table_mutants() {
  std::vector<CatalogueEntry> list;
  add_descriptor_repair(list);
  add_reader(list);
  add_timers(list);
  add_channel(list);
  add_fastdds(list);
  add_cyclone(list);
  return list;
}

}  // namespace stormproof::mutate
