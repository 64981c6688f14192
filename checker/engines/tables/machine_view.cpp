// Evaluates the guards of every row of every table once, over free inputs.
#include "checker/engines/tables/machine_view.hpp"

#include "checker/engines/tables/free_input.hpp"
#include "checker/engines/tables/proof.hpp"
#include "fsm/reopening_repair.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::tables {
namespace {

template <class Machine>
MachineView view(const std::vector<fsm::TableMutation>& mutations) {
  MachineView machine{fsm::Reflect<Machine>::info(), {}, {}};
  Unknowns unknowns;
  const auto input = free_input<Machine>(unknowns);
  const fsm::RowTable<Machine, smt::Symbolic> table{mutations};
  for (const auto& row : table.rows()) {
    machine.rows.push_back(
        {row.source, row.event, row.target, row.enabled(input).expr().simplify()});
  }
  machine.inputs = unknowns.list();
  return machine;
}

std::vector<MachineView> all_machines(const std::vector<fsm::TableMutation>& mutations) {
  return {view<fsm::DescriptorRepair>(mutations), view<fsm::DiscoveryReader>(mutations),
          view<fsm::HeartbeatTimer>(mutations),   view<fsm::InitialAckNack>(mutations),
          view<fsm::Announcer>(mutations),        view<fsm::Channel>(mutations),
          view<fsm::ChangeForReader>(mutations),  view<fsm::SingleShot>(mutations),
          view<fsm::ControlWriter>(mutations),    view<fsm::ControlReader>(mutations),
          view<fsm::CautiousReader>(mutations),   view<fsm::MatchedReader>(mutations),
          view<fsm::HeartbeatPacer>(mutations),   view<fsm::EventThread>(mutations),
          view<fsm::MovableTimer>(mutations),     view<fsm::ReopeningRepair>(mutations)};
}

}  // namespace

std::vector<MachineView> machine_views(const Proof& proof) {
  std::vector<MachineView> machines = all_machines(proof.mistakes().tables);
  std::erase_if(machines, [&](const MachineView& one) { return !proof.concerns(one.info.name); });
  return machines;
}

}  // namespace stormproof::tables
