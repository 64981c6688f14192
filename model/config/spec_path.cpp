// Look-up of names and paths. Only existence is checked here; reading the file gives its own
// errors.
#include "model/config/spec_path.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <dlfcn.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "model/config/distributions.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/tree/tree.hpp"
#include "model/config/vendor/reference.hpp"

namespace stormproof::model::config {
namespace fs = std::filesystem;
namespace {

constexpr const char* file_ending = ".yaml";

bool file_exists(const fs::path& path) {
  std::error_code failed;
  return fs::exists(path, failed);
}

/// PREFIX/share/stormproof/specs of a program in PREFIX/bin: a package may be installed elsewhere
/// than it was configured for.
std::optional<std::string> beside_program() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (failed) return std::nullopt;
  const fs::path specs = program.parent_path().parent_path() / "share/stormproof/specs";
  if (!fs::is_directory(specs, failed)) return std::nullopt;
  return specs.string();
}

/// The folder `specs` beside the file of this code, if that is no program: a Python package has its
/// own.
std::optional<std::string> beside_module() {
  Dl_info found{};
  if (dladdr(file_ending, &found) == 0) return std::nullopt;
  std::error_code failed;
  const fs::path file = found.dli_fname;
  const fs::path specs = file.parent_path() / "specs";
  if (fs::equivalent(file, "/proc/self/exe", failed) || failed) return std::nullopt;
  return fs::is_directory(specs, failed) ? std::optional{specs.string()} : std::nullopt;
}

std::optional<std::string> file_named(const std::vector<std::string>& directories, SpecKind kind,
                                      const std::string& name) {
  for (const std::string& directory : directories) {
    const fs::path file = fs::path{directory} / folder_name(kind) / (name + file_ending);
    if (!name.empty() && file_exists(file)) return file.string();
  }
  return std::nullopt;
}

/// "; did you mean '…'?", of these names, or of a file beside it without its ending.
std::string nearest(const std::string& reference, const std::vector<std::string>& names) {
  if (!reference.empty() && file_exists(reference + file_ending)) {
    return fmt::format("; did you mean {}?", quote(reference + file_ending));
  }
  return suggestion(reference, names);
}

}  // namespace

std::string folder_name(SpecKind kind) {
  switch (kind) {
    case SpecKind::scenarios:
      return "scenarios";
    case SpecKind::dds:
      return "dds";
    case SpecKind::wireless:
      return "wireless";
    case SpecKind::hosts:
      return "hosts";
    case SpecKind::grids:
      return "grids";
    case SpecKind::museum:
      return "museum";
    case SpecKind::policies:
      return "policies";
  }
  return {};
}

bool is_path(std::string_view reference) {
  return reference.find('/') != std::string_view::npos || reference.ends_with(".yaml") ||
         reference.ends_with(".yml");
}

SpecPath SpecPath::standard() {
  SpecPath path;
  if (const char* variable = std::getenv("STORMPROOF_SPECS")) {
    std::istringstream list{variable};
    for (std::string directory; std::getline(list, directory, ':');) {
      if (!directory.empty()) path.directories.push_back(directory);
    }
  }
#ifdef STORMPROOF_SPECS_DIR
  path.directories.emplace_back(STORMPROOF_SPECS_DIR);
#endif
  if (auto beside = beside_program()) path.directories.push_back(*std::move(beside));
  if (auto beside = beside_module()) path.directories.push_back(*std::move(beside));
#ifdef STORMPROOF_INSTALLED_SPECS_DIR
  path.directories.emplace_back(STORMPROOF_INSTALLED_SPECS_DIR);
#endif
  return path;
}

std::vector<std::string> SpecPath::names(SpecKind kind) const {
  std::vector<std::string> names;
  for (const std::string& directory : directories) {
    std::error_code failed;
    fs::directory_iterator files{fs::path{directory} / folder_name(kind), failed};
    for (; !failed && files != fs::directory_iterator{}; files.increment(failed)) {
      if (files->path().extension() == file_ending) names.push_back(files->path().stem().string());
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::optional<std::string> SpecPath::named(SpecKind kind, const std::string& name) const {
  auto file = file_named(directories, kind, name);
  if (file || kind != SpecKind::dds) return file;
  const auto distributions = read_distributions(directories);
  if (!distributions) return std::nullopt;  // `find` says what is wrong
  const auto meant = std::ranges::find(*distributions, name, &Distribution::name);
  if (meant == distributions->end()) return std::nullopt;
  return file_named(directories, kind, meant->profile);
}

std::optional<std::string> SpecPath::name_of(SpecKind kind, const std::string& file) const {
  const fs::path path{file};
  if (path.extension() != file_ending) return std::nullopt;
  const std::string parent = path.has_parent_path() ? path.parent_path().string() : ".";
  for (const std::string& directory : directories) {
    std::error_code failed;
    if (fs::equivalent(fs::path{directory} / folder_name(kind), parent, failed)) {
      return path.stem().string();
    }
  }
  return std::nullopt;
}

Result<std::string> SpecPath::find(SpecKind kind, const std::string& reference,
                                   const std::string& from_directory,
                                   const std::string& where) const {
  if (kind == SpecKind::scenarios && reference == "-") return std::string{"/dev/stdin"};
  if (is_path(reference) || vendor::parse_reference(reference)) {
    const fs::path beside =
        fs::path{from_directory} / reference;  // `reference` itself if it is absolute
    if (file_exists(beside)) return beside.lexically_normal().string();
    if (file_exists(reference)) return reference;
    const std::string places =
        beside == reference ? reference : fmt::format("{}, {}", beside.string(), reference);
    return InputError{where, fmt::format("no file {}; looked for {}", quote(reference), places)};
  }
  if (const auto file = named(kind, reference)) return *file;
  if (!reference.empty()) {
    const fs::path beside = fs::path{from_directory} / reference;
    if (file_exists(beside)) return beside.lexically_normal().string();
    if (file_exists(reference)) return reference;
  }
  std::vector<std::string> known = names(kind);
  if (kind == SpecKind::dds) {
    const auto distributions = read_distributions(directories);
    if (!distributions) return distributions.error();
    for (const Distribution& one : *distributions) known.push_back(one.name);
    const auto successor = successor_of(directories, reference);
    if (!successor) return successor.error();
    if (!successor->empty()) {
      return InputError{where, fmt::format("{} is not shipped any more; expected {} in its place",
                                           quote(reference), *successor)};
    }
  }
  return InputError{
      where, fmt::format("no {} file named {}{}; expected one of {}, or a path", folder_name(kind),
                         quote(reference), nearest(reference, known), fmt::join(known, ", "))};
}

Result<std::string> SpecPath::find(SpecKind kind, const std::string& reference,
                                   std::string_view noun) const {
  if (is_path(reference)) return reference;
  if (const auto file = named(kind, reference)) return *file;
  if (!reference.empty() && file_exists(reference)) return reference;
  return no_such(reference, noun, names(kind));
}

InputError no_such(const std::string& reference, std::string_view noun,
                   const std::vector<std::string>& names) {
  return {reference, fmt::format("no {} of this name{}; expected one of {}, or a path", noun,
                                 nearest(reference, names), fmt::join(names, ", "))};
}

}  // namespace stormproof::model::config
