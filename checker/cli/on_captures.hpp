// Commands that are printed for the reader to run on the captures that were given.
#pragma once

#include <string>
#include <vector>

#include "checker/presentation/text/command_line.hpp"

namespace stormproof::cli {

/// "stormproof VERB… FILE… OPTION…", quoted.
[[nodiscard]] inline std::string on_captures(std::vector<std::string> words,
                                             const std::vector<std::string>& files,
                                             const std::vector<std::string>& options = {}) {
  words.insert(words.end(), files.begin(), files.end());
  words.insert(words.end(), options.begin(), options.end());
  return report::command_line(words);
}

}  // namespace stormproof::cli
