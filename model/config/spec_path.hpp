// Where profiles and scenarios that are given by name are looked for: a list of `specs` folders.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/tree/result.hpp"

namespace stormproof::model::config {

/// What a file below `specs` is; the folder there has the same name.
enum class SpecKind { scenarios, dds, wireless, hosts, grids, policies, museum };

[[nodiscard]] std::string folder_name(SpecKind kind);

/// Whether `reference` is that of a YAML file, not a name: it has a '/' or ends in .yaml or .yml.
[[nodiscard]] bool is_path(std::string_view reference);

struct SpecPath {
  std::vector<std::string> directories;  ///< the first one that has the file wins

  /// The folders in the environment variable STORMPROOF_SPECS (separated by ':'), then those of the
  /// source tree that this program was built from, then the installed ones: beside the program, in
  /// the Python package that this code is a part of, where they were to be installed.
  [[nodiscard]] static SpecPath standard();

  /// All names of a kind, sorted.
  [[nodiscard]] std::vector<std::string> names(SpecKind kind) const;

  /// The file of this name; of a DDS profile, the name may be that of a ROS 2 distribution
  /// (distributions.hpp), if there is no file of this name.
  [[nodiscard]] std::optional<std::string> named(SpecKind kind, const std::string& name) const;

  /// The name of `file` if it is one of those that `find` can find by name.
  [[nodiscard]] std::optional<std::string> name_of(SpecKind kind, const std::string& file) const;

  /// The file that `reference` means: a path if it has a '/' or ends in .yaml, .yml or .xml
  /// (relative to `from_directory`, then to the current directory), otherwise a name, or, if there
  /// is none, a file without an ending in these directories. `where` places the error.
  [[nodiscard]] Result<std::string> find(SpecKind kind, const std::string& reference,
                                         const std::string& from_directory,
                                         const std::string& where) const;

  /// The same for what is read apart from scenarios and profiles: `noun` ("grid") names it. Paths
  /// are relative to the current directory.
  [[nodiscard]] Result<std::string> find(SpecKind kind, const std::string& reference,
                                         std::string_view noun) const;
};

/// "no grid of this name; did you mean …; expected one of …, or a path".
[[nodiscard]] InputError no_such(const std::string& reference, std::string_view noun,
                                 const std::vector<std::string>& names);

}  // namespace stormproof::model::config
