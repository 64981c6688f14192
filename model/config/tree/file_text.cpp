// Reads in pieces: what is named need not be an ordinary file, and a size need not be true.
#include "model/config/tree/file_text.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include <sys/stat.h>

namespace stormproof::model::config {

namespace {

using Identity = std::pair<dev_t, ino_t>;

std::mutex read_mutex;
std::set<Identity> read_files;

std::optional<Identity> identity_of(const std::string& path) {
  struct stat file {};
  if (stat(path.c_str(), &file) != 0 || !S_ISREG(file.st_mode)) return std::nullopt;
  return Identity{file.st_dev, file.st_ino};
}

}  // namespace

Result<std::string> file_text(const std::string& path, std::size_t most) {
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed)) {
    return InputError{path, "is a directory; expected a file"};
  }
  std::ifstream file{path, std::ios::binary};
  std::string text;
  std::array<char, 65'536> chunk{};
  while (file && text.size() <= most) {
    file.read(chunk.data(), chunk.size());
    text.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
  }
  // The end of a file that was read completely sets eofbit; a file that could not be opened does
  // not.
  if (!file.eof() && text.size() <= most) return InputError{path, "cannot be read"};
  if (const auto identity = identity_of(path)) {
    const std::lock_guard lock{read_mutex};
    read_files.insert(*identity);
  }
  return text;
}

bool was_read(const std::string& path) {
  const auto identity = identity_of(path);
  const std::lock_guard lock{read_mutex};
  return identity && read_files.contains(*identity);
}

}  // namespace stormproof::model::config
