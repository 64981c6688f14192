// `stormproof draw [MACHINE]`: diagrams of the protocol machines, from their transition tables.
#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/presentation/diagrams/draw_machine.hpp"
#include "fsm/machines.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

struct DrawArguments {
  std::string machine;  ///< name; empty: all machines
  draw::Format format = draw::Format::mermaid;
  OutputFile file;        ///< instead of stdout
  std::string directory;  ///< for one file per machine; empty: none
};

using fsm::MachineInfo;

std::string unknown_machine(const std::string& name, const std::vector<MachineInfo>& machines) {
  std::vector<std::string> names;
  std::string list;
  for (const MachineInfo& machine : machines) {
    names.emplace_back(machine.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  return fmt::format("'{}' is not a machine{}; expected one of {}", name,
                     model::config::suggestion(name, names), list);
}

/// All machines in one text: Mermaid in a document with headings, graphs of dot one after another.
std::string draw_all(const std::vector<MachineInfo>& machines, draw::Format format) {
  std::string text;
  for (const MachineInfo& machine : machines) {
    if (!text.empty()) text += "\n";
    const std::string drawing = draw_machine(machine, format);
    if (format == draw::Format::mermaid)
      text += fmt::format("## {}\n\n```mermaid\n{}```\n", machine.name, drawing);
    else
      text += drawing;
  }
  return text;
}

Outcome write_each(const std::string& directory, const std::vector<MachineInfo>& machines,
                   draw::Format format) {
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  if (failed) {
    return Complaint{fmt::format("{}: cannot be created: {}", directory, failed.message())};
  }
  for (const MachineInfo& machine : machines) {
    const std::string name = fmt::format("{}.{}", machine.name, draw::file_ending(format));
    const std::string path = (std::filesystem::path{directory} / name).string();
    OutputFile file{path};
    auto error = file.open_error();
    if (!error) file.stream() << draw_machine(machine, format);
    if (!error) error = file.commit();
    if (error) return Complaint{*error};
    fmt::print("{}\n", path);
  }
  return established;
}

Outcome run(DrawArguments& arguments, Session& /*session*/) {
  std::vector<MachineInfo> machines = fsm::machines();
  if (!arguments.machine.empty()) {
    const auto wanted = std::ranges::find(machines, arguments.machine, &MachineInfo::name);
    if (wanted == machines.end()) return Complaint{unknown_machine(arguments.machine, machines)};
    machines = {MachineInfo{*wanted}};
  }
  if (!arguments.directory.empty()) {
    return write_each(arguments.directory, machines, arguments.format);
  }
  if (arguments.machine.empty() && arguments.format == draw::Format::svg) {
    return Complaint{"an SVG file holds one machine; name one, or a folder with --directory DIR"};
  }
  const std::string drawn = arguments.machine.empty()
                                ? draw_all(machines, arguments.format)
                                : draw_machine(machines.front(), arguments.format);
  if (!arguments.file.wanted()) fmt::print("{}", drawn);
  if (arguments.file.wanted()) arguments.file.stream() << drawn;
  return established;
}

void declare(Options& options, DrawArguments& arguments) {
  options.text("machine", arguments.machine, "Name of a machine; without it, all of them",
               "MACHINE");
  options.choice(
      "--format", arguments.format,
      {{"mermaid", draw::Format::mermaid}, {"dot", draw::Format::dot}, {"svg", draw::Format::svg}},
      "mermaid (default), dot or svg", "FORMAT");
  const Option file =
      options.output("-o,--output", arguments.file, "Write to a file instead of stdout");
  options.folder("--directory", arguments.directory, "Write one file for each machine")
      .excludes(file);
}

}  // namespace

void declare_draw(Frame& frame) {
  frame.add<DrawArguments>(
      {.name = "draw",
       .help = "Draw a state machine from its transition table, or all of them",
       .exit_codes = "Exit code: 0, or 2 bad input.",
       .formats = Formats::none},
      declare, run);
}

}  // namespace stormproof::cli
