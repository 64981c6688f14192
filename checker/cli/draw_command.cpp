// `stormproof draw [MACHINE]`: diagrams of the protocol machines, from their transition tables, and
// of what happens between them.
#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/draw_composition.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/cli/streams.hpp"
#include "checker/presentation/composition/composition_comparison.hpp"
#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/diagrams/draw_machine.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "fsm/machines.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::cli {

namespace {

struct DrawArguments {
  std::string machine;             ///< name, or "composition"; empty: all machines
  CompositionRequest composition;  ///< and the format of either
  OutputFile file;                 ///< instead of stdout
  std::string directory;           ///< for one file per machine; empty: none
};

using fsm::MachineInfo;

std::string unknown_machine(const std::string& name, const std::vector<MachineInfo>& machines) {
  std::vector<std::string> names;
  std::string list;
  for (const MachineInfo& machine : machines) {
    names.emplace_back(machine.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  names.emplace_back("composition");
  list += ", or composition";
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
  if (const auto error = make_folder("--directory", directory)) return Complaint{*error};
  for (const MachineInfo& machine : machines) {
    const std::string name = fmt::format("{}.{}", machine.name, draw::file_ending(format));
    const std::string path = (std::filesystem::path{directory} / name).string();
    OutputFile file{path};
    auto error = file.open_error();
    if (!error) file.stream() << draw_machine(machine, format);
    if (!error) error = file.commit();
    if (error) return Complaint{*error};
    print(path + "\n");
  }
  return established;
}

Outcome show(const std::string& drawn, OutputFile& file) {
  if (file.wanted()) {
    file.stream() << drawn;
  } else {
    print(drawn);
  }
  return established;
}

Outcome show_json(const std::vector<MachineInfo>& machines, DrawArguments& arguments,
                  const Session& session) {
  if (!arguments.directory.empty()) {
    return Complaint{"--directory is for drawings; the JSON of all machines is one file: -o FILE"};
  }
  return show(report::dumped(
                  with_head(draw::machines_json(machines), session.command(), established, false)),
              arguments.file);
}

Outcome run_composition(DrawArguments& arguments, const Session& session) {
  if (!arguments.directory.empty()) {
    return Complaint{"--directory is for machines; a composition is one page: -o FILE"};
  }
  arguments.composition.to_file = arguments.file.wanted();
  const auto drawn = draw_composition(arguments.composition, session);
  if (const auto* complaint = std::get_if<Complaint>(&drawn)) return *complaint;
  return show(std::get<std::string>(drawn), arguments.file);
}

/// Nothing, if it is a format of machines.
std::optional<draw::Format> machine_format(DrawFormat format) {
  switch (format) {
    case DrawFormat::usual:
    case DrawFormat::mermaid:
      return draw::Format::mermaid;
    case DrawFormat::dot:
      return draw::Format::dot;
    case DrawFormat::svg:
      return draw::Format::svg;
    case DrawFormat::text:
    case DrawFormat::json:
      break;
  }
  return std::nullopt;
}

Outcome run(DrawArguments& arguments, Session& session) {
  const CompositionRequest& composition = arguments.composition;
  if (arguments.machine == "composition") return run_composition(arguments, session);
  if (!composition.dds.empty() || composition.compare || !composition.profiles.empty()) {
    return Complaint{"profiles, --dds and --compare are for `draw composition`"};
  }
  const bool as_json = composition.format == DrawFormat::json;
  const std::optional<draw::Format> format = machine_format(composition.format);
  if (!format && !as_json) return Complaint{"a machine is drawn as mermaid, dot, svg or json"};
  std::vector<MachineInfo> machines = fsm::machines();
  if (!arguments.machine.empty()) {
    const auto wanted = std::ranges::find(machines, arguments.machine, &MachineInfo::name);
    if (wanted == machines.end()) return Complaint{unknown_machine(arguments.machine, machines)};
    machines = {MachineInfo{*wanted}};
  }
  if (as_json) return show_json(machines, arguments, session);
  if (!arguments.directory.empty()) return write_each(arguments.directory, machines, *format);
  if (arguments.machine.empty() && *format == draw::Format::svg) {
    return Complaint{"an SVG file holds one machine; name one, or a folder with --directory DIR"};
  }
  return show(arguments.machine.empty() ? draw_all(machines, *format)
                                        : draw_machine(machines.front(), *format),
              arguments.file);
}

void declare(Options& options, DrawArguments& arguments) {
  options.text("machine", arguments.machine,
               "Name of a machine, or `composition`: what happens between them; without it, all "
               "machines",
               "MACHINE");
  options.texts("profiles", arguments.composition.profiles,
                "With --compare: two DDS profiles or compositions", "PROFILE");
  options
      .choice(
          "--format", arguments.composition.format,
          {{"mermaid", DrawFormat::mermaid},
           {"dot", DrawFormat::dot},
           {"svg", DrawFormat::svg},
           {"text", DrawFormat::text},
           {"json", DrawFormat::json}},
          "Of machines mermaid (default), dot, svg or json; of a composition text (default), svg, "
          "mermaid or json",
          "FORMAT")
      .not_repeated();
  options.text("--dds", arguments.composition.dds,
               "Composition of this DDS profile's implementation, or the one of this name, as "
               "fastdds-living (default: the paper's)",
               "PROFILE");
  options.flag("--compare", arguments.composition.compare,
               "What the compositions of two DDS profiles share and where they differ");
  const Option file =
      options.output("-o,--output", arguments.file, "Write to a file instead of stdout");
  options.folder("--directory", arguments.directory, "Write one file for each machine")
      .excludes(file);
}

}  // namespace

void declare_draw(Frame& frame) {
  frame.add<DrawArguments>(
      {.name = "draw",
       .help = "Draw a state machine from its transition table, all of them, or what connects them",
       .exit_codes = "Exit code: 0, or 2 bad input.",
       .formats = Formats::none,
       .schemas = {draw::machines_schema, draw::composition_schema, draw::comparison_schema}},
      declare, run);
}

}  // namespace stormproof::cli
