// Machines as JSON: their tables with names for numbers.
#include "checker/presentation/diagrams/draw_machine.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::fsm {

/// With a state and an event, as its parts name each other by number.
static MachineInfo example_of(report::Type<MachineInfo>) {
  return {.name = "", .initial = 0, .states = {""}, .events = {""}, .rows = {}};
}

}  // namespace stormproof::fsm

namespace stormproof::draw {

namespace {

struct NamedRow {
  const fsm::MachineInfo& machine;
  const fsm::RowInfo& row;
};

template <class V>
void describe(V& v, const NamedRow& named) {
  v("source", named.machine.states[named.row.source]);
  v("event", named.machine.events[named.row.event]);
  v("target", named.machine.states[named.row.target]);
  v("guard", named.row.guard);
  v("action", named.row.action);
}

struct NamedMachine {
  const fsm::MachineInfo& machine;
};

template <class V>
void describe(V& v, const NamedMachine& named) {
  const fsm::MachineInfo& machine = named.machine;
  std::vector<NamedRow> rows;
  for (const fsm::RowInfo& row : machine.rows) rows.push_back({machine, row});
  v("name", machine.name);
  v("initial", machine.states[machine.initial]);
  v("states", machine.states);
  v("events", machine.events);
  v("rows", rows);
}

struct Machines {
  const std::vector<fsm::MachineInfo>& all;
};

template <class V>
void describe(V& v, const Machines& machines) {
  std::vector<NamedMachine> named;
  for (const fsm::MachineInfo& machine : machines.all) named.push_back({machine});
  v("machines", named);
}

}  // namespace

nlohmann::ordered_json machines_json(const std::vector<fsm::MachineInfo>& machines) {
  return report::json_of(Machines{machines});
}

nlohmann::ordered_json machines_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Machines>(definitions);
}

}  // namespace stormproof::draw
