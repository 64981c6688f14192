// Mermaid and dot need no layout; they are written here. The SVG has a layout of its own
// (machine_svg.cpp).
#include "checker/presentation/diagrams/draw_machine.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "checker/presentation/diagrams/machine_svg.hpp"
#include "checker/presentation/diagrams/mermaid_text.hpp"
#include "fsm/state_words.hpp"

namespace stormproof::draw {

namespace {

std::string mermaid(const fsm::MachineInfo& machine) {
  std::string text = fmt::format("stateDiagram-v2\n  %% {}\n  [*] --> {}\n", machine.name,
                                 machine.states[machine.initial]);
  for (const std::string_view state : machine.states) {
    const std::string_view words = fsm::words_of_state(state);
    if (!words.empty()) text += fmt::format("  {0} : {0} {1}\n", state, words);
  }
  for (const fsm::RowInfo& row : machine.rows) {
    text += fmt::format("  {} --> {} : {}\n", machine.states[row.source],
                        machine.states[row.target], mermaid_text(row_text(machine, row)));
  }
  return text;
}

/// Rows between the same two states share an edge, one line each.
std::string dot(const fsm::MachineInfo& machine) {
  std::string text = fmt::format(
      "digraph {} {{\n  label=\"{}\";\n  labelloc=t;\n  fontname=\"Helvetica\";\n"
      "  node [shape=box, style=rounded, fontname=\"Helvetica\"];\n"
      "  edge [fontname=\"Helvetica\", fontsize=10];\n"
      "  initial [shape=point, width=0.15, label=\"\"];\n",
      machine.name, machine.name);
  for (const std::string_view state : machine.states) {
    const std::string_view words = fsm::words_of_state(state);
    text += words.empty() ? fmt::format("  \"{}\";\n", state)
                          : fmt::format("  \"{0}\" [label=\"{0}\\n{1}\"];\n", state, words);
  }
  text += fmt::format("  initial -> \"{}\";\n", machine.states[machine.initial]);
  std::map<std::pair<fsm::StateId, fsm::StateId>, std::string> labels;
  for (const fsm::RowInfo& row : machine.rows) {
    labels[{row.source, row.target}] += row_text(machine, row) + "\\l";
  }
  for (const auto& [ends, label] : labels) {
    text += fmt::format("  \"{}\" -> \"{}\" [label=\"{}\"];\n", machine.states[ends.first],
                        machine.states[ends.second], label);
  }
  return text + "}\n";
}

}  // namespace

const char* file_ending(Format format) {
  switch (format) {
    case Format::mermaid:
      return "mmd";
    case Format::dot:
      return "dot";
    case Format::svg:
      return "svg";
  }
  return "";
}

std::string row_text(const fsm::MachineInfo& machine, const fsm::RowInfo& row) {
  std::string text{machine.events[row.event]};
  if (row.guard != "none") text += fmt::format(" [{}]", row.guard);
  if (row.action != "none") text += fmt::format(" / {}", row.action);
  return text;
}

std::string draw_machine(const fsm::MachineInfo& machine, Format format) {
  switch (format) {
    case Format::mermaid:
      return mermaid(machine);
    case Format::dot:
      return dot(machine);
    case Format::svg:
      return machine_svg(machine);
  }
  return "";
}

}  // namespace stormproof::draw
