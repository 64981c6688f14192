// A guard that only asks for a knob has the same answer throughout a run. Rows behind such a guard,
// and rows out of states that only such rows lead to, are ruled out.
#include "checker/evidence/conform/report/coverage.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "fsm/machines.hpp"
#include "model/implementations.hpp"

namespace stormproof::conform {

namespace {

using fsm::MachineInfo;

struct KnobGuard {
  std::string_view guard;
  bool holds;
  std::string knob;
};

/// The guards that ask for knobs only.
std::array<KnobGuard, 4> knob_guards(const model::DdsProfile& dds) {
  const model::ImplementationTraits& traits = model::traits_of(dds);
  const bool is_built_in = traits.fixed_rules.has_value();
  const model::RelationRules rules = model::rules_of(dds);
  const bool is_adaptive = dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
  const bool is_additive = rules.heartbeat_timer == model::HeartbeatTimerKind::additive;
  const bool accepts = rules.unmatched == model::Unmatched::accept;
  const std::string built_in = fmt::format("implementation: {}", traits.name);
  const bool has_initial = dds.sedp.initial_acknack_delay.count() > 0;
  return {{{"Adaptive", is_adaptive,
            is_adaptive ? "sedp.heartbeat_policy: adaptive" : "sedp.heartbeat_policy: periodic"},
           {"Additive", is_additive,
            is_built_in   ? built_in
            : is_additive ? "sedp.heartbeat_timer: additive"
                          : "sedp.heartbeat_timer: single"},
           {"AcceptsUnmatched", accepts,
            is_built_in ? built_in
            : accepts   ? "sedp.unmatched: accept"
                        : "sedp.unmatched: drop"},
           {"Enabled", has_initial,
            has_initial ? "sedp.initial_acknack_delay above 0" : "sedp.initial_acknack_delay: 0"}}};
}

/// The knob that makes the guard ("Waiting and not Adaptive") false.
std::optional<std::string_view> refuting_knob(std::string_view guard,
                                              const std::array<KnobGuard, 4>& knobs) {
  constexpr std::string_view conjunction = " and ";
  constexpr std::string_view negation = "not ";
  while (!guard.empty()) {
    const std::size_t end = std::min(guard.find(conjunction), guard.size());
    std::string_view literal = guard.substr(0, end);
    guard.remove_prefix(std::min(end + conjunction.size(), guard.size()));
    const bool is_negated = literal.starts_with(negation);
    if (is_negated) literal.remove_prefix(negation.size());
    for (const KnobGuard& one : knobs) {
      if (one.guard == literal && one.holds == is_negated) return one.knob;
    }
  }
  return std::nullopt;
}

/// States that the rows without a reason lead to.
std::vector<bool> reachable_states(const MachineInfo& machine,
                                   const std::vector<std::string>& reasons) {
  std::vector<bool> reachable(machine.states.size(), false);
  reachable[machine.initial] = true;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t row = 0; row < machine.rows.size(); ++row) {
      const fsm::RowInfo& info = machine.rows[row];
      if (!reasons[row].empty() || !reachable[info.source] || reachable[info.target]) continue;
      reachable[info.target] = true;
      grows = true;
    }
  }
  return reachable;
}

/// The reasons of rows out of unreachable states: those of the rows that lead there.
void spread(const MachineInfo& machine, std::vector<std::string>& reasons) {
  const std::vector<bool> reachable = reachable_states(machine, reasons);
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t row = 0; row < machine.rows.size(); ++row) {
      const auto source = machine.rows[row].source;
      if (!reasons[row].empty() || reachable[source]) continue;
      for (std::size_t other = 0; other < machine.rows.size(); ++other) {
        if (machine.rows[other].target != source || reasons[other].empty()) continue;
        reasons[row] = reasons[other];
        grows = true;
        break;
      }
    }
  }
}

}  // namespace

std::vector<std::string> ruled_out(std::string_view machine, const model::DdsProfile& dds) {
  const std::vector<MachineInfo> machines = fsm::machines();
  const auto found = std::ranges::find(machines, machine, &MachineInfo::name);
  if (found == machines.end()) return {};
  const auto knobs = knob_guards(dds);
  std::vector<std::string> reasons;
  for (const fsm::RowInfo& row : found->rows) {
    reasons.emplace_back(refuting_knob(row.guard, knobs).value_or(""));
  }
  spread(*found, reasons);
  return reasons;
}

std::vector<MachineCoverage> coverage_of(const std::vector<RowUse>& rows,
                                         const model::DdsProfile& dds) {
  std::vector<MachineCoverage> machines;
  std::vector<std::string> reasons;
  for (const RowUse& use : rows) {
    if (machines.empty() || machines.back().machine != use.machine) {
      machines.push_back({std::string{use.machine}, {}, 0, 0});
      reasons = ruled_out(use.machine, dds);
    }
    MachineCoverage& machine = machines.back();
    RowCoverage row{&use, {}};
    if (use.times > 0) {
      ++machine.used;
    } else if (use.row < reasons.size() && !reasons[use.row].empty()) {
      row.ruled_out_by = reasons[use.row];
      ++machine.ruled_out;
    }
    machine.rows.push_back(std::move(row));
  }
  return machines;
}

}  // namespace stormproof::conform
