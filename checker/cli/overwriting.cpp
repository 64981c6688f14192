// The identity of a file that exists, or of the place where it will.
#include "checker/cli/overwriting.hpp"

#include <filesystem>
#include <tuple>

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stormproof::cli {

namespace {

namespace fs = std::filesystem;

/// Device, inode and, of what does not exist yet, its name in the folder of that inode.
using Identity = std::tuple<dev_t, ino_t, std::string>;

std::optional<Identity> identity_of(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) == 0) {
    if (!S_ISREG(found.st_mode)) return std::nullopt;
    return Identity{found.st_dev, found.st_ino, ""};
  }
  const fs::path place{path};
  const std::string folder = place.has_parent_path() ? place.parent_path().string() : ".";
  if (stat(folder.c_str(), &found) != 0) return std::nullopt;
  return Identity{found.st_dev, found.st_ino, place.filename().string()};
}

std::optional<Identity> identity_of(int descriptor) {
  struct stat found {};
  if (fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return Identity{found.st_dev, found.st_ino, ""};
}

/// The files that a value may name: itself, what stands behind "key=", and both without the
/// "#PROFILE" and "@PRESET" of vendor XML.
std::vector<std::string> files_in(const std::string& value) {
  std::vector<std::string> files{value};
  const std::size_t equals = value.find('=');
  if (equals != std::string::npos) files.push_back(value.substr(equals + 1));
  for (std::size_t k = 0; k < 2 && k < files.size(); ++k) {
    const std::size_t mark = files[k].find_first_of("#@");
    if (mark != std::string::npos) files.push_back(files[k].substr(0, mark));
  }
  return files;
}

std::optional<std::string> input_like(const Identity& written, const std::vector<Given>& given) {
  for (const auto& [option, values] : given) {
    for (const std::string& value : values) {
      for (const std::string& file : files_in(value)) {
        struct stat found {};
        const bool exists = stat(file.c_str(), &found) == 0;
        if (exists && identity_of(file) == written)
          return option.empty() ? value : option + " " + value;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> overwriting(const std::vector<Target>& targets,
                                       const std::vector<Given>& given) {
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const auto& [option, path] = targets[k];
    const auto identity = identity_of(path);
    if (!identity) continue;
    const std::string label = option + " " + path;
    if (const auto input = input_like(*identity, given)) {
      return fmt::format("{}: would replace an input, {}", label, *input);
    }
    for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
      if (identity_of(descriptor) != identity) continue;
      return fmt::format("{}: is where standard {} goes", label,
                         descriptor == STDOUT_FILENO ? "output" : "error");
    }
    for (std::size_t other = 0; other < k; ++other) {
      if (identity_of(targets[other].path) != identity) continue;
      return fmt::format("{}: is the same file as {} {}", label, targets[other].option,
                         targets[other].path);
    }
  }
  return std::nullopt;
}

}  // namespace stormproof::cli
