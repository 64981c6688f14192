// Collects names and descriptions where they are.
#include "checker/verification/listing/listing.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/presentation/text/plain_text.hpp"
#include "checker/verification/mutate/mutants.hpp"
#include "fsm/machines.hpp"
#include "model/config/distributions.hpp"
#include "model/config/tree/file_text.hpp"
#include "model/config/tree/yaml_text.hpp"
#include "props/property.hpp"

namespace stormproof::listing {

namespace {

namespace fs = std::filesystem;
namespace config = model::config;
using config::SpecKind;
using config::SpecPath;
using Entries = std::vector<Entry>;

/// What stands under `key` in a YAML or JSON file, as text; the reason if it cannot be read.
std::string text_in(const std::string& file, std::string_view key) {
  const auto tree = config::load_yaml(file);
  if (!tree) return "cannot be read: " + tree.error().message;
  const config::Node* node = tree->find(key);
  return node != nullptr && node->is_scalar() ? node->text : "";
}

/// By what their files say under `key`.
Entries described(SpecKind kind, const SpecPath& specs, std::string_view key = "description") {
  Entries entries;
  for (const std::string& name : specs.names(kind)) {
    const std::string file = specs.named(kind, name).value_or("");
    entries.push_back({name, text_in(file, key), file});
  }
  return entries;
}

Entries profiles(const SpecPath& specs) {
  Entries entries = described(SpecKind::dds, specs);
  const auto distributions = config::read_distributions(specs.directories);
  if (!distributions) return entries;
  for (const config::Distribution& one : *distributions) {
    entries.push_back({one.name, statement_of(one), one.source});
  }
  return entries;
}

/// Files with this ending below `folder` of the specs, by path.
std::vector<fs::path> files_in(const SpecPath& specs, const char* folder, const char* ending) {
  std::vector<fs::path> files;
  for (const std::string& directory : specs.directories) {
    std::error_code failed;
    fs::recursive_directory_iterator found{fs::path{directory} / folder, failed};
    for (; !failed && found != fs::recursive_directory_iterator{}; found.increment(failed)) {
      if (found->path().string().ends_with(ending)) files.push_back(found->path());
    }
    if (!files.empty()) break;  // the folders after it have the same
  }
  std::ranges::sort(files);
  return files;
}

constexpr std::size_t most_bytes = 1'000'000;

Entries findings(const SpecPath& specs) {
  Entries entries;
  for (const fs::path& page : files_in(specs, "findings", ".md")) {
    const auto text = config::file_text(page.string(), most_bytes);
    std::string title = text ? text->substr(0, text->find('\n')) : text.error().message;
    if (title.starts_with("# ")) title.erase(0, 2);
    fs::path scenario = page;
    scenario.replace_extension(".yaml");
    const fs::path& named = fs::exists(scenario) ? scenario : page;
    entries.push_back({named.string(), std::move(title), page.string()});
  }
  return entries;
}

Entries captures(const SpecPath& specs) {
  constexpr const char* ending = ".pcap.xz";
  Entries entries;
  for (const fs::path& file : files_in(specs, "captures", ending)) {
    std::string about = file.string();
    about.replace(about.size() - std::string_view{ending}.size(), std::string::npos, ".json");
    const auto tree = config::load_yaml(about);
    const auto value = [&](const char* key) {
      const config::Node* node = tree ? tree->find(key) : nullptr;
      return node != nullptr && node->is_scalar() ? node->text : std::string{"?"};
    };
    entries.push_back(
        {file.string(),
         fmt::format("{}, {} hosts with {} participants of {} user endpoints, {}",
                     value("implementation"), value("hosts"), value("participants_per_host"),
                     value("endpoints_per_participant"), value("medium")),
         about});
  }
  return entries;
}

/// The first sentence of the first comment.
Entries vendor_files(const SpecPath& specs) {
  constexpr std::string_view begin = "<!--";
  Entries entries;
  for (const fs::path& file : files_in(specs, "vendor", ".xml")) {
    const auto text = config::file_text(file.string(), most_bytes);
    std::string comment = text ? *text : text.error().message;
    if (const std::size_t at = comment.find(begin); at != std::string::npos) {
      comment = comment.substr(at + begin.size(), comment.find("-->", at) - at - begin.size());
    }
    comment = report::one_line(comment);
    entries.push_back({file.string(), comment.substr(0, comment.find(". ")), file.string()});
  }
  return entries;
}

Entries machines() {
  Entries entries;
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    entries.push_back(
        {std::string{machine.name},
         fmt::format("{} in {} rows", fmt::join(machine.states, ", "), machine.rows.size())});
  }
  return entries;
}

Entries mutants() {
  Entries entries;
  for (const mutate::CatalogueEntry& entry : mutate::mutants()) {
    entries.push_back({entry.mutant.id, entry.mutant.description});
  }
  return entries;
}

Entries properties() {
  Entries entries;
  for (const props::Property& property : props::catalogue()) {
    entries.push_back({std::string{property.id}, std::string{property.statement}});
  }
  return entries;
}

/// How each kind is called, where its names go, and who knows them.
struct Kind {
  std::string_view name;
  std::string_view where;
  Entries (*entries)(const SpecPath&);
};
constexpr Kind all_kinds[] = {
    {"scenarios", "simulate, check, fuzz, sensitivity, tune; diff --over",
     [](const SpecPath& specs) { return described(SpecKind::scenarios, specs); }},
    {"profiles", "--set dds=, --dds, --compare, --preset; both sides of diff", profiles},
    {"wireless", "--set wireless=, --wireless",
     [](const SpecPath& specs) { return described(SpecKind::wireless, specs); }},
    {"hosts",
     "--set hosts=", [](const SpecPath& specs) { return described(SpecKind::hosts, specs); }},
    {"grids", "sweep; diff --over",
     [](const SpecPath& specs) { return described(SpecKind::grids, specs); }},
    {"exhibits", "museum, diff --exhibit",
     [](const SpecPath& specs) { return described(SpecKind::museum, specs, "title"); }},
    {"policies", "diff --policy",
     [](const SpecPath& specs) { return described(SpecKind::policies, specs); }},
    {"machines", "draw", [](const SpecPath&) { return machines(); }},
    {"mutants", "mutate --mutant", [](const SpecPath&) { return mutants(); }},
    {"properties", "check --property, fuzz --property, tune --keep",
     [](const SpecPath&) { return properties(); }},
    {"findings", "simulate, as files; those that end in .md are to read", findings},
    {"captures", "capture summarize, conform, validate, as files", captures},
    {"vendor", "wherever a DDS profile goes, as files", vendor_files}};

}  // namespace

std::span<const std::string_view> kinds() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Kind& kind : all_kinds) all.push_back(kind.name);
    return all;
  }();
  return names;
}

List list_of(std::string_view kind, const SpecPath& specs) {
  const auto* const found = std::ranges::find(all_kinds, kind, &Kind::name);
  if (found == std::end(all_kinds)) return {};
  return {found->name, found->where, found->entries(specs)};
}

}  // namespace stormproof::listing
