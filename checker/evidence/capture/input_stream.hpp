// What a capture is read from: a file, a pipe, or standard input ("-"). Its first bytes say how it
// is compressed, and a pipe cannot be wound back, so they are kept and given again.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "checker/evidence/capture/bytes.hpp"
#include "model/config/tree/result.hpp"

namespace stormproof::capture {

struct FileCloser {
  void operator()(std::FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

struct InputStream {
  static constexpr std::size_t start_size = 6;

  File file{};  ///< at its beginning
  std::array<std::uint8_t, start_size> start{};
  std::size_t start_length = 0;

  [[nodiscard]] Bytes first_bytes() const { return {start.data(), start_length}; }
};

/// An error if there is no such file, or it is a directory, a terminal or another device, or a pipe
/// into which nobody writes.
[[nodiscard]] model::config::Result<InputStream> open_stream(const std::string& path);

}  // namespace stormproof::capture
