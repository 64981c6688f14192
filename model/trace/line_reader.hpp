// Reading of a text file line by line, in bounded memory: a file that is not what its reader
// expects (a disk image, one endless line) must not fill the memory.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace stormproof::model::trace {

class LineReader {
 public:
  static constexpr std::size_t max_line_bytes = std::size_t{64} << 20U;

  enum class Status : std::uint8_t {
    line,          ///< a line that ends in a line feed
    unterminated,  ///< the last line, which does not
    end,           ///< no more lines
    too_long,      ///< more than `max_line_bytes` without a line feed
    unreadable     ///< the file cannot be read
  };

  explicit LineReader(const std::string& file) : in_{file, std::ios::binary} {}

  /// Reads the next line into `text()`, without its line feed.
  Status next();

  [[nodiscard]] const std::string& text() const { return text_; }
  /// Number of the line in `text()`, from 1; 0 before the first.
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  /// Reads the next block; false at the end of the file.
  bool refill();

  std::ifstream in_;
  std::string block_;
  std::size_t used_ = 0;  // bytes of the block that have become lines
  std::string text_;
  std::uint64_t number_ = 0;
};

}  // namespace stormproof::model::trace
