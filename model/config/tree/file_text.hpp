// The text of a file that a user named: the first step of reading.
#pragma once

#include <string>

#include "model/config/tree/result.hpp"

namespace stormproof::model::config {

/// Up to `most` bytes of a file, and one more if it is longer. Errors: not readable, a directory.
[[nodiscard]] Result<std::string> file_text(const std::string& path, std::size_t most);

/// Whether `file_text` has read this very file (by device and inode) in this process: then nothing
/// that is written may take its place.
[[nodiscard]] bool was_read(const std::string& path);

}  // namespace stormproof::model::config
