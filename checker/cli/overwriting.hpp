// Refuses, before any work, outputs that would replace an input or each other. Files are compared
// by device and inode, so other paths and links to the same file count, too.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/cli/given.hpp"

namespace stormproof::cli {

/// Something that will be written: the option as it was given, and where to.
struct Target {
  std::string option;
  std::string path;
};

/// What two of `targets`, or one of them and a file that was `given`, have in common; nothing if
/// all of them are different files. Devices and pipes may be written twice.
[[nodiscard]] std::optional<std::string> overwriting(const std::vector<Target>& targets,
                                                     const std::vector<Given>& given);

}  // namespace stormproof::cli
