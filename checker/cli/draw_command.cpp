// Chooses the machines, draws them, writes them where they are wanted.
#include "checker/cli/draw_command.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/core.h>

#include "checker/cli/complain.hpp"
#include "checker/cli/exit_code.hpp"
#include "checker/cli/output_file.hpp"
#include "fsm/machines.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

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

int write(const std::string& path, const std::string& text) {
  OutputFile file{path};
  if (const auto error = file.open_error()) return complain(*error);
  if (!file.wanted()) {
    fmt::print("{}", text);
    return established;
  }
  file.stream() << text;
  if (const auto error = file.commit()) return complain(*error);
  return established;
}

int write_each(const std::string& directory, const std::vector<MachineInfo>& machines,
               draw::Format format) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) return complain(fmt::format("{}: cannot be created: {}", directory, error.message()));
  for (const MachineInfo& machine : machines) {
    const std::string name = fmt::format("{}.{}", machine.name, draw::file_ending(format));
    const std::string path = (std::filesystem::path{directory} / name).string();
    if (const int code = write(path, draw_machine(machine, format)); code != established) {
      return code;
    }
    fmt::print("{}\n", path);
  }
  return established;
}

}  // namespace

int draw(const DrawArguments& arguments) {
  std::vector<MachineInfo> machines = fsm::machines();
  if (!arguments.machine.empty()) {
    const auto wanted = std::ranges::find(machines, arguments.machine, &MachineInfo::name);
    if (wanted == machines.end()) return complain(unknown_machine(arguments.machine, machines));
    machines = {MachineInfo{*wanted}};
  }
  if (!arguments.directory.empty()) {
    if (!arguments.file.empty()) return complain("--output and --directory exclude each other");
    return write_each(arguments.directory, machines, arguments.format);
  }
  if (!arguments.machine.empty()) {
    return write(arguments.file, draw_machine(machines.front(), arguments.format));
  }
  if (arguments.format == draw::Format::svg) {
    return complain("an SVG file holds one machine; name one, or a folder with --directory DIR");
  }
  return write(arguments.file, draw_all(machines, arguments.format));
}

}  // namespace stormproof::cli
