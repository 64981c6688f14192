// Values from the command line, `--set key.path=value`, that go over those of a file. Whatever goes
// wrong with them is reported at the argument, not at the file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/config/tree/tree.hpp"

namespace stormproof::model::config {

struct Override {
  std::string path;  ///< dotted
  Node value;        ///< all of it placed at "--set path=value"
};

/// Takes arguments of the form "key.path=value" apart; the value is YAML.
[[nodiscard]] Result<std::vector<Override>> parse_overrides(std::span<const std::string> arguments);

/// Puts the value into `root`.
[[nodiscard]] std::optional<InputError> apply(const Override& change, Node& root);

}  // namespace stormproof::model::config
