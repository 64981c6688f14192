// Diagrams of the protocol machines, drawn from the reflected transition tables that the simulator
// executes: nothing in them is maintained by hand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/json/schema_form.hpp"
#include "fsm/machine_info.hpp"

namespace stormproof::draw {

enum class Format : std::uint8_t {
  mermaid,  ///< stateDiagram-v2
  dot,      ///< graphviz
  svg       ///< self-contained, for light and dark
};

/// The ending of files in this format: "mmd", "dot", "svg".
[[nodiscard]] const char* file_ending(Format format);

/// The diagram of a machine: its states, and each row of its table as "event [guard] / action".
[[nodiscard]] std::string draw_machine(const fsm::MachineInfo& machine, Format format);

/// Keys: machines (name, initial, states, events, and the rows of the table: source, event, target,
/// guard, action).
[[nodiscard]] nlohmann::ordered_json machines_json(const std::vector<fsm::MachineInfo>& machines);
[[nodiscard]] nlohmann::ordered_json machines_schema(report::SchemaDefinitions& definitions);

/// "AckNackReceived [Listed] / Request": a row without its states.
[[nodiscard]] std::string row_text(const fsm::MachineInfo& machine, const fsm::RowInfo& row);

}  // namespace stormproof::draw
