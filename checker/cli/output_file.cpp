// Writing to a temporary file and renaming it.
#include "checker/cli/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fmt/core.h>

namespace stormproof::cli {

void OutputFile::open(const std::string& path) {
  path_ = path;
  if (path_.empty()) return;
  // A device or pipe (/dev/stdout, /dev/null) cannot be replaced; it is written as it is.
  std::error_code ignored;
  const auto status = std::filesystem::status(path_, ignored);
  const bool special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  temporary_ = special ? path_ : path_ + ".partial";
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  done_ = false;
}

std::optional<std::string> OutputFile::open_error() const {
  if (!wanted() || stream_.is_open()) return std::nullopt;
  return path_ + ": cannot be written: " + std::strerror(errno);
}

std::optional<std::string> OutputFile::commit() {
  if (done_) return std::nullopt;
  stream_.close();
  if (stream_.fail()) return path_ + ": could not be written completely (is the disk full?)";
  std::error_code error;
  if (temporary_ != path_) std::filesystem::rename(temporary_, path_, error);
  if (error) return path_ + ": " + error.message();
  done_ = true;
  return std::nullopt;
}

void OutputFile::discard() {
  if (done_) return;
  done_ = true;
  stream_.close();
  std::error_code ignored;
  if (temporary_ != path_) std::filesystem::remove(temporary_, ignored);
}

std::optional<std::string> make_folder(const char* option, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return std::nullopt;
  return fmt::format("{} {}: cannot be created: {}", option, folder, error.message());
}

}  // namespace stormproof::cli
