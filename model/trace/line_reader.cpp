// Blocks from the file, lines from the blocks.
#include "model/trace/line_reader.hpp"

#include <algorithm>

namespace stormproof::model::trace {

bool LineReader::refill() {
  constexpr std::size_t block_bytes = std::size_t{1} << 16U;
  block_.resize(block_bytes);
  in_.read(block_.data(), static_cast<std::streamsize>(block_bytes));
  block_.resize(static_cast<std::size_t>(in_.gcount()));
  used_ = 0;
  return !block_.empty();
}

LineReader::Status LineReader::next() {
  text_.clear();
  if (!in_.is_open() || in_.bad()) return Status::unreadable;
  bool started = false;
  while (used_ < block_.size() || refill()) {
    if (!started) ++number_;
    started = true;
    const std::size_t end = std::min(block_.find('\n', used_), block_.size());
    if (text_.size() + (end - used_) > max_line_bytes) return Status::too_long;
    text_.append(block_, used_, end - used_);
    used_ = end;
    if (end == block_.size()) continue;
    ++used_;
    return Status::line;
  }
  if (in_.bad()) return Status::unreadable;
  return started ? Status::unterminated : Status::end;
}

}  // namespace stormproof::model::trace
