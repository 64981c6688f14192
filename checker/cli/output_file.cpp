// Writing to a temporary file and renaming it.
#include "checker/cli/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include "model/config/tree/file_text.hpp"

namespace stormproof::cli {

namespace {

namespace fs = std::filesystem;

/// The temporary files that exist now.
std::mutex temporaries_mutex;
std::set<std::string> temporaries;

void remember(const std::string& path) {
  const std::lock_guard lock{temporaries_mutex};
  temporaries.insert(path);
}

void forget(const std::string& path) {
  const std::lock_guard lock{temporaries_mutex};
  temporaries.erase(path);
}

/// Makes a file beside `target` that nobody else has; its name, or nothing and `errno`.
std::optional<std::string> make_temporary(const std::string& target) {
  for (int k = 0; k < 1000; ++k) {
    std::string name = fmt::format("{}.{}-{}.partial", target, getpid(), k);
    const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      close(file);
      return name;
    }
    if (errno != EEXIST) break;
  }
  return std::nullopt;
}

/// The file that the path stands for: behind symbolic links, as far as they lead to something.
std::string behind_links(const std::string& path) {
  std::error_code failed;
  const fs::path real = fs::canonical(path, failed);
  return failed ? path : real.string();
}

}  // namespace

void OutputFile::open(const std::string& path, const std::string& label) {
  path_ = path;
  if (path_.empty()) return;
  label_ = label.empty() ? path : label;
  if (auto reason = open_temporary())
    error_ = fmt::format("{}: cannot be written: {}", label_, *reason);
}

std::optional<std::string> OutputFile::open_temporary() {
  std::error_code ignored;
  const auto status = fs::status(path_, ignored);
  if (fs::is_directory(status)) return "it is a folder";
  // A device or pipe (/dev/stdout, /dev/null) cannot be replaced; it is written as it is.
  const bool special = fs::exists(status) && !fs::is_regular_file(status);
  target_ = special ? path_ : behind_links(path_);
  temporary_ = target_;
  errno = 0;
  if (!special) {
    if (fs::exists(status) && access(target_.c_str(), W_OK) != 0) return std::strerror(errno);
    const auto made = make_temporary(target_);
    if (!made) return std::strerror(errno);
    temporary_ = *made;
    remember(temporary_);
  }
  done_ = false;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_.is_open()) return std::strerror(errno);
  return std::nullopt;
}

std::optional<std::string> OutputFile::commit() {
  if (done_) return std::nullopt;
  errno = 0;
  stream_.close();
  if (stream_.fail()) {
    const std::string why = errno == 0 ? "is the disk full?" : std::strerror(errno);
    discard();
    return fmt::format("{}: could not be written completely: {}", label_, why);
  }
  if (model::config::was_read(target_)) {
    discard();
    return label_ + ": is not written: it would replace a file that was read";
  }
  std::error_code error;
  if (!is_special()) fs::rename(temporary_, target_, error);
  if (error) {
    discard();
    return fmt::format("{}: could not be written: {}", label_, error.message());
  }
  forget(temporary_);
  done_ = true;
  return std::nullopt;
}

void OutputFile::discard() {
  if (done_) return;
  done_ = true;
  stream_.close();
  if (is_special()) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
  forget(temporary_);
}

void OutputFile::discard_all() {
  const std::unique_lock lock{temporaries_mutex, std::try_to_lock};
  if (!lock) return;
  for (const std::string& path : temporaries) unlink(path.c_str());
}

std::optional<std::string> make_folder(const char* option, const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fmt::format("{} {}: cannot be created: {}", option, folder, error.message());
  const OutputFile trial{(fs::path{folder} / "stormproof").string()};
  if (!trial.open_error()) return std::nullopt;
  return fmt::format("{} {}: cannot be written into: {}", option, folder, std::strerror(errno));
}

}  // namespace stormproof::cli
