// Difference constraints, solved by relaxation.
#include "checker/engines/explorer/path.hpp"

#include <fmt/core.h>

#include "props/monitors/describe.hpp"

namespace stormproof::explorer {

std::optional<std::vector<std::int64_t>> earliest_times(
    std::uint32_t variables, const std::vector<Constraint>& constraints) {
  std::vector<std::int64_t> time(variables, 0);
  // x_a - x_b <= c is x_b >= x_a - c: lift until nothing moves; more rounds than variables mean a
  // contradiction, and so does a start that moves.
  for (std::uint32_t round = 0; round <= variables; ++round) {
    bool moved = false;
    for (const Constraint& constraint : constraints) {
      const std::int64_t least = time[constraint.a] - constraint.c;
      if (time[constraint.b] >= least) continue;
      time[constraint.b] = least;
      moved = true;
    }
    if (time[0] != 0) return std::nullopt;
    if (!moved) return time;
  }
  return std::nullopt;
}

std::optional<ConcretePath> solve(const PathLog& log, std::vector<std::string> states) {
  const auto times = earliest_times(log.variables, log.constraints);
  if (!times) return std::nullopt;
  const auto at = [&](std::uint32_t variable) { return model::Nanoseconds{(*times)[variable]}; };
  ConcretePath path;
  for (std::size_t k = 0; k < log.fired.size(); ++k) {
    path.steps.push_back({log.fired[k].slot, at(log.fired[k].variable), std::move(states[k])});
  }
  for (const PathLog::Fired& event : log.scheduled) {
    path.scheduled.push_back({event.slot, at(event.variable)});
  }
  for (const PathLog::Emission& emission : log.emissions) {
    ConcretePath::Packet packet{emission.packet, at(emission.emitted), {}, {}};
    if (emission.received != PathLog::none) packet.one_way = at(emission.received) - packet.emitted;
    if (emission.left_source != PathLog::none) {
      packet.leaves_after = at(emission.left_source) - packet.emitted;
    }
    path.packets.push_back(packet);
  }
  return path;
}

std::optional<model::Nanoseconds> ConcretePath::time_of(What what, unsigned relation) const {
  for (const Scheduled& event : scheduled) {
    if (event.slot.what == what && event.slot.relation == relation) return event.time;
  }
  return std::nullopt;
}

namespace {

std::string set_text(std::uint16_t set) {
  std::string text;
  for (unsigned d = 0; d < 16; ++d) {
    if ((set >> d & 1) != 0) text += fmt::format("{}{}", text.empty() ? "" : ",", d);
  }
  return "{" + text + "}";
}

std::string what_text(const Slot& slot) {
  switch (slot.what) {
    case What::data:
      return fmt::format("DATA {}{} received", set_text(slot.set),
                         slot.has(Slot::carries_heartbeat) ? " with HEARTBEAT" : "");
    case What::heartbeat:
      return "HEARTBEAT received";
    case What::acknack:
      return fmt::format("{}ACKNACK, missing {}, received",
                         slot.has(Slot::initial) ? "initial " : "", set_text(slot.set));
    case What::source_completion:
      return fmt::format("repair DATA {} left the source", set_text(slot.set));
    case What::heartbeat_expiry:
      return "HEARTBEAT timer expires";
    case What::acknack_generation:
      return "ACKNACK due";
    case What::initial_acknack_due:
      return "initial ACKNACK due";
    case What::repair_generation:
      return "repair due";
    case What::suppression_end:
      return "suppression ends";
    case What::nack_response:
      return "nack response due";
    case What::async_run:
      return "asynchronous queue runs";
    case What::heartbeat_time:
      return "HEARTBEAT timer due";
    case What::ack_time:
      return "ACK timer due";
    case What::thread_run:
      return slot.number == 0 ? "the writer's thread runs" : "the reader's thread runs";
    case What::creation:
      return fmt::format("descriptor {} created", set_text(slot.set));
    case What::reader_opens:
      return "the reader side opens";
    case What::writer_opens:
      return "the writer side opens";
    default:
      return "";
  }
}

}  // namespace

std::string step_text(const ConcretePath::Step& step, const Scope& scope) {
  const bool which_reader = scope.readers > 1 && is_of_reader(step.slot.what);
  const bool which_writer = scope.writers > 1 && is_of_writer(step.slot.what);
  const std::string whose =
      which_reader || which_writer ? " (" + relation_text(scope, step.slot.relation) + ")" : "";
  return fmt::format("t = {}: {}{} [{}]", props::time_text(step.time), what_text(step.slot), whose,
                     step.state);
}

}  // namespace stormproof::explorer
