// Reads in pieces: what is named need not be an ordinary file, and a size need not be true.
#include "model/config/tree/file_text.hpp"

#include <array>
#include <filesystem>
#include <fstream>

namespace stormproof::model::config {

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
  return text;
}

}  // namespace stormproof::model::config
