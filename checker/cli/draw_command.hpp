// `stormproof draw [MACHINE]`: diagrams of the protocol machines, from their transition tables.
#pragma once

#include <string>

#include "checker/presentation/diagrams/draw_machine.hpp"

namespace stormproof::cli {

struct DrawArguments {
  std::string machine;  ///< name; empty: all machines
  draw::Format format = draw::Format::mermaid;
  std::string file;       ///< where to write; empty: to stdout
  std::string directory;  ///< for one file per machine; empty: none
};

/// Exit code: established, or bad_input for a machine that does not exist, a file that cannot be
/// written, `file` and `directory` at once, or all machines as SVG without a directory.
[[nodiscard]] int draw(const DrawArguments& arguments);

}  // namespace stormproof::cli
